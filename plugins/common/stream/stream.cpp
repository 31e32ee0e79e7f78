// SPDX-License-Identifier: MIT
#include "plugins/common/stream/stream.hpp"

#include <algorithm>

#include "muro/algorithm.hpp"
#include "muro/ext/report_entries.hpp"
#include "plugins/common/stream/endpoint.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::stream {

namespace {

/// Of a recording: what is no Event.
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
        inputs(ExternalInputs::of(host)) {
    if (inputs && !(channel = inputs->channel(name)))
      throw Error("two streams have the name " + quote(name) + "; give their algorithms different names");
    if (address.lockstep.empty()) return;
    Lockstep* const clients = Lockstep::of(host);
    if (!clients)
      throw Error("stream " + quote(name) + " has `lockstep`, but the program that runs this cannot wait for clients");
    lockstep = &clients->join(address.lockstep, name, address.timeout);
  }

  ~Impl() { close(); }

  void open() {
    if (endpoint || is_replayed() || (inputs && !inputs->may_open())) return;
    io = IoThread::shared();
    exchange = std::make_unique<Exchange>(limits, address.clients, lockstep);
    connections = std::make_unique<Connections>(*io, *exchange, framing, address.clients);
    auto opened = make_endpoint({*io, *connections, address, name, host});
    opened->open();
    endpoint = std::move(opened);
    io->call([this] { endpoint->start(); });
  }

  void close() {
    if (!endpoint) return;
    io->call([this] {
      endpoint->close();
      connections->close();
    });
    io->call([] {});  // what was under way has ended, too
    endpoint.reset();
  }

  bool is_replayed() const { return channel && channel->is_replayed(); }

  void poll(std::int64_t its_time) {
    time = its_time;
    has_handed_out_message = false;
    if (endpoint) collect();
  }

  void begin(std::int64_t its_time) {
    poll(its_time);
    if (!endpoint) return;
    if (lockstep && !has_message()) {
      wait();
      collect();
    }
  }

  /// What has come since, behind what has not been handed out yet.
  void collect() {
    if (!exchange->has_arrived() || (!is_read_through() && (!lockstep || has_message()))) return;
    if (is_read_through()) {
      inbox.clear();
      next_entry = 0;
    }
    if (exchange->collect(inbox)) io->signal(*connections);
  }

  bool has_message() const {
    return std::any_of(inbox.entries.begin() + std::ptrdiff_t(next_entry), inbox.entries.end(),
                       [](const Inbox::Entry& e) { return e.kind == Event::Kind::message; });
  }

  const Event* next() {
    if (!endpoint) return replay();
    if (is_read_through() || (lockstep && has_handed_out_message)) return nullptr;
    const Inbox::Entry& entry = inbox.entries[next_entry++];
    has_handed_out_message |= entry.kind == Event::Kind::message;
    event = {entry.kind, entry.client, std::string_view(inbox.bytes).substr(entry.begin, entry.size)};
    if (entry.kind == Event::Kind::disconnected && !limits.has_late_replies) disconnect(entry.client);
    record({std::uint32_t(event.kind), event.client, event.bytes});
    return &event;
  }

  void record(const ExternalInput& input) {
    if (channel && limits.is_recorded) channel->record(time, input);
  }

  const Event* replay() {
    ExternalInput input;
    while (is_replayed() && channel->replay(time, input)) {
      if (input.kind == timed_out_kind) {
        time_out();
        continue;
      }
      event = {Event::Kind(input.kind), input.source, input.bytes};
      return &event;
    }
    return nullptr;
  }

  void wait() {
    if (lockstep->wait(time) != LockstepStream::Outcome::timed_out) return;
    record({timed_out_kind, 0, {}});
    time_out();
  }

  void time_out() {
    const std::string what = "client " + quote(address.lockstep) + " of stream " + quote(name) + " (" + address.text() +
                             ") said nothing for " + std::to_string(address.timeout) + " s, and time waits for it";
    if (address.ends_on_timeout)
      throw Error(what + "; start it, raise `timeout`, or let time go on without it by `on_timeout: go_on`");
    if (inputs) inputs->not_repeatable(what);
  }

  bool send(Exchange::Sent sent) {
    if (sent == Exchange::Sent::queued) io->signal(*connections);
    return sent != Exchange::Sent::dropped;
  }

  void disconnect(std::uint32_t client) {
    if (endpoint && exchange->end(client)) io->signal(*connections);
  }

  void finish() {
    if (!exchange) return;
    const Statistics s = exchange->statistics();
    const std::pair<const char*, std::uint64_t> numbers[] = {
        {"clients", s.clients},     {"refused", s.refused}, {"messages", s.messages},        {"bytes_in", s.bytes_in},
        {"bytes_out", s.bytes_out}, {"dropped", s.dropped}, {"disconnected", s.disconnected}};
    if (ReportEntries* const report = ReportEntries::of(host))
      for (const auto& [key, value] : numbers) report->set({"streams", name, key, value});
    if (s.refused + s.dropped + s.disconnected == 0) return;
    host.log(LogLevel::warning,
             "stream " + quote(name) + " (" + address.text() + ") had trouble with clients: it refused " +
                 std::to_string(s.refused) + " above its bound of " + std::to_string(address.clients) + ", dropped " +
                 std::to_string(s.dropped) + " replies that were not read in time, and disconnected " +
                 std::to_string(s.disconnected) + " that did not keep to the protocol");
  }

  bool is_read_through() const { return next_entry == inbox.entries.size(); }

  const std::string name;
  Address address;
  const Framing framing;
  const Limits limits;
  Host& host;
  ExternalInputs* const inputs;
  InputChannel* channel = nullptr;
  LockstepStream* lockstep = nullptr;

  std::shared_ptr<IoThread> io;
  std::unique_ptr<Exchange> exchange;
  std::unique_ptr<Connections> connections;
  std::unique_ptr<Endpoint> endpoint;  ///< null: not open

  std::int64_t time = 0;
  Inbox inbox;
  std::size_t next_entry = 0;
  bool has_handed_out_message =
      false;  ///< in this step; in lockstep it is the last: the wall clock has a say in what more there is
  Event event;
};

Stream::Stream(Connector& connector, std::string name, Address address, Framing framing, Limits limits)
    : impl_(std::make_unique<Impl>(connector, std::move(name), std::move(address), framing, limits)) {}
Stream::~Stream() = default;

void Stream::open() { impl_->open(); }
void Stream::begin(std::int64_t time) { impl_->begin(time); }
void Stream::poll(std::int64_t time) { impl_->poll(time); }
const Event* Stream::next() { return impl_->next(); }

bool Stream::send(std::uint32_t client, std::string_view bytes) {
  return !impl_->endpoint || impl_->send(impl_->exchange->send(client, bytes));
}

bool Stream::send(std::uint32_t client, std::string_view bytes, std::size_t most) {
  return !impl_->endpoint || impl_->send(impl_->exchange->send(client, bytes, most));
}

void Stream::send_to_all(std::string_view bytes) {
  if (impl_->endpoint) impl_->send(impl_->exchange->send_to_all(bytes));
}

void Stream::answered() {
  if (impl_->lockstep && impl_->endpoint) impl_->lockstep->message_answered();
}

void Stream::set_subscribed(bool subscribed) {
  if (impl_->lockstep && impl_->endpoint) impl_->lockstep->set_subscribed(subscribed);
}

void Stream::disconnect(std::uint32_t client) { impl_->disconnect(client); }
void Stream::set_baud(std::uint32_t) {}
void Stream::finish() { impl_->finish(); }
bool Stream::is_replayed() const { return impl_->is_replayed(); }
const Address& Stream::address() const { return impl_->address; }
const std::string& Stream::name() const { return impl_->name; }
Statistics Stream::statistics() const { return impl_->exchange ? impl_->exchange->statistics() : Statistics{}; }

}  // namespace muro::stream
