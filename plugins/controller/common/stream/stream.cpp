// SPDX-License-Identifier: MIT
#include "plugins/controller/common/stream/stream.hpp"

#include <utility>

#include "muro/algorithm.hpp"
#include "muro/base/number_text.hpp"
#include "muro/ext/report_entries.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/stream/live_stream.hpp"
#include "plugins/controller/common/stream/looked_at_stream.hpp"

namespace muro::stream {

namespace {

/// Kind of a recorded input that is no Event: the client for which time waits sent nothing in time.
constexpr std::uint32_t timed_out_kind = 3;

}  // namespace

class Stream::Impl {
 public:
  Impl(Connector& connector, std::string its_name, Address its_address, const Framing& its_framing,
       const Limits& its_limits)
      : name(std::move(its_name)),
        address(std::move(its_address)),
        framing(its_framing),
        limits(its_limits),
        host(connector.host()),
        inputs(ExternalInputs::of(host)),
        report(ReportEntries::of(host)) {
    if (inputs && !(channel = inputs->channel(name)))
      throw Error("two streams have the name " + quote(name) + "; give their algorithms different names");
    if (address.lockstep.empty()) return;
    Lockstep* const clients = Lockstep::of(host);
    if (!clients)
      throw Error("stream " + quote(name) + " has `lockstep`, but the program that runs this cannot wait for clients");
    lockstep = &clients->join(address.lockstep, name, address.timeout);
  }

  bool is_replayed() const { return channel && channel->is_replayed(); }

  void open() {
    if (inputs && !inputs->may_open()) return look();
    if (live || is_replayed()) return;
    live = std::make_unique<LiveStream>(name, address, framing, limits, host, lockstep);
  }

  /// Throws the errors that a run would throw.
  void look() {
    if (!is_replayed()) {
      if (!looked_at) looked_at = std::make_unique<LookedAtStream>(name, address);
      return;
    }
    for (ExternalInput input; channel->replay(-1, input);) check_kind(input);
  }

  void check_kind(const ExternalInput& input) const {
    if (input.kind > timed_out_kind)
      throw Error("the recording cannot be replayed: kind " + std::to_string(input.kind) + " of stream " + quote(name) +
                  " is none of 0 to " + std::to_string(timed_out_kind));
  }

  void begin(std::int64_t its_time) {
    time = its_time;
    if (!live || live->begin(time)) return;
    record({timed_out_kind, 0, {}});
    time_out();
  }

  void poll(std::int64_t its_time) {
    time = its_time;
    if (live) live->poll(time);
  }

  void record(const ExternalInput& input) const {
    if (channel && limits.is_recorded) channel->record(time, input);
  }

  const Event* next() {
    if (!live) return replay();
    const Event* const event = live->next();
    if (!event) return nullptr;
    record({std::uint32_t(event->kind), event->client, event->bytes});
    if (event->kind == Event::Kind::message && address.lockstep.empty() && !std::exchange(has_told, true)) tell();
    return event;
  }

  /// Marks the run as not repeatable. When messages are not recorded, their receiver reports this instead.
  void tell() const {
    if (inputs && limits.is_recorded)
      inputs->not_repeatable("stream " + quote(name) +
                             " is not in lockstep: when its messages take effect depends on the wall clock");
  }

  const Event* replay() {
    ExternalInput input;
    while (is_replayed() && channel->replay(time, input)) {
      if (input.kind == timed_out_kind) {
        time_out();
        continue;
      }
      check_kind(input);
      replayed = {Event::Kind(input.kind), input.source, input.bytes};
      return &replayed;
    }
    return nullptr;
  }

  void time_out() const {
    const std::string what = "client " + quote(address.lockstep) + ", for which time waits, said nothing on stream " +
                             quote(name) + " (" + address.text() + ") for " + number_text(address.timeout) + " s";
    if (address.ends_on_timeout)
      throw Error(what + "; start it, raise `timeout`, or let time go on without it by `on_timeout: go_on`");
    if (inputs && !is_replayed()) inputs->not_repeatable(what);
  }

  void finish() const {
    if (!live) return;
    const Statistics s = live->statistics();
    const std::pair<std::string_view, std::uint64_t> numbers[] = {
        {"clients", s.clients},           {"refused", s.refused},     {"messages", s.messages},
        {"bytes_in", s.bytes_in},         {"bytes_out", s.bytes_out}, {"dropped", s.dropped},
        {"disconnected", s.disconnected}, {"lost", s.lost},           {"held_back", s.held_back}};
    if (report)
      for (const auto& [key, value] : numbers) report->set({"streams", name, key, double(value)});
    if (s.refused + s.dropped + s.disconnected == 0) return;
    host.log(LogLevel::warning,
             "stream " + quote(name) + " (" + address.text() + ") had trouble with clients: it refused " +
                 std::to_string(s.refused) + " above its bound of " + std::to_string(address.clients) + ", dropped " +
                 std::to_string(s.dropped) + " replies that were not read in time, and disconnected " +
                 std::to_string(s.disconnected) + " that did not keep to the protocol");
  }

  const std::string name;
  Address address;
  const Framing framing;
  const Limits limits;
  Host& host;
  ExternalInputs* const inputs;
  ReportEntries* const report;
  InputChannel* channel = nullptr;
  LockstepStream* lockstep = nullptr;
  std::int64_t time = 0;
  bool has_told = false;
  Event replayed;
  std::unique_ptr<LiveStream> live;           ///< null: not open
  std::unique_ptr<LookedAtStream> looked_at;  ///< when the scenario is only checked
};

Stream::Stream(Connector& connector, std::string name, Address address, Framing framing, Limits limits)
    : impl_(std::make_unique<Impl>(connector, std::move(name), std::move(address), framing, limits)) {}
Stream::~Stream() = default;

void Stream::open() { impl_->open(); }
void Stream::begin(std::int64_t time) { impl_->begin(time); }
void Stream::poll(std::int64_t time) { impl_->poll(time); }
const Event* Stream::next() { return impl_->next(); }
bool Stream::send(std::uint32_t client, std::string_view bytes) {
  return !impl_->live || impl_->live->send(client, bytes);
}
bool Stream::send(std::uint32_t client, std::string_view bytes, std::size_t most) {
  return !impl_->live || impl_->live->send(client, bytes, most);
}
std::size_t Stream::waiting(std::uint32_t client) const { return impl_->live ? impl_->live->waiting(client) : 0; }
void Stream::send_to_all(std::string_view bytes) {
  if (impl_->live) impl_->live->send_to_all(bytes);
}
void Stream::hold(std::uint32_t client, bool held) {
  if (impl_->live) impl_->live->hold(client, held);
}
void Stream::answered() {
  if (impl_->live) impl_->live->answered();
}
void Stream::set_subscribed(bool subscribed) {
  if (impl_->live && impl_->lockstep) impl_->lockstep->set_subscribed(subscribed);
}
void Stream::disconnect(std::uint32_t client) {
  if (impl_->live) impl_->live->disconnect(client);
}
void Stream::set_baud(std::uint32_t baud) {
  if (impl_->live) impl_->live->set_baud(baud);
}
void Stream::finish() { impl_->finish(); }

bool Stream::is_replayed() const { return impl_->is_replayed(); }
const Address& Stream::address() const { return impl_->address; }
const std::string& Stream::name() const { return impl_->name; }
Statistics Stream::statistics() const { return impl_->live ? impl_->live->statistics() : Statistics{}; }

}  // namespace muro::stream
