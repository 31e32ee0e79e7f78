// SPDX-License-Identifier: MIT
// Access to any property, and control of the run, for external programs, by JSON-RPC 2.0; see README.md.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "muro/ext/inspection.hpp"
#include "muro/plugin.hpp"
#include "plugins/common/text/quote.hpp"
#include "request_framing.hpp"
#include "service.hpp"
#include "setup.hpp"
#include "token.hpp"

namespace {

using namespace muro;
using namespace muro::jsonrpc;

constexpr Parameter parameters[] = {
    stream::stream_parameter().required(),
    texts("write", "what clients may change: \"object:property\" and \"call:NAME\", with * and ?; default: nothing"),
    texts("token", "a secret that clients have to say first: {file: PATH} or {environment: NAME}"),
    texts("tls", "encrypts, for clients on other machines: {certificate: FILE, key: FILE} in PEM format"),
    texts("refresh", "what is brought up to date for each step though it is computed on demand; default: \"*:pose\""),
};
constexpr PropertyUse reads[] = {{"*", "what clients ask for"}};
constexpr PropertyUse writes[] = {{"*", "what `write` grants, through the host, which records it"}};
constexpr Description description{
    .id = "controller.jsonrpc",
    .kind = Kind::controller,
    .version = "1.0.0",
    .summary = "Any property, and the control of the run, for programs outside: JSON-RPC 2.0, one message a line",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | restorable | runs_alone,
};

constexpr stream::Limits limits{.output_bytes = 32 << 20, .is_recorded = false, .has_late_replies = true};
/// Limit of waiting output (bytes) for updates: above it they are dropped. The rest is for replies.
constexpr std::size_t most_for_updates = 4 << 20;
/// Limit of waiting output (bytes) for new requests: above it none is begun. The rest is for the reply to one message.
constexpr std::size_t most_for_requests = 12 << 20;
constexpr auto time_in_a_step = std::chrono::milliseconds(5);

class JsonRpc final : public Algorithm, private Outlet, private PauseAttendant {
 public:
  void connect(Connector& c) override {
    const Item item = c.items().empty() ? Item{} : c.items()[0];
    if (c.items().size() > 1)
      throw Error("one server serves the whole scene; use it for one robot, or under `algorithms`");
    inspection_ = Inspection::of(c.host());
    run_ = RunControl::of(c.host());
    inputs_ = ExternalInputs::of(c.host());
    host_ = &c.host();
    if (!inspection_ || !run_) throw Error("this host lets nobody look at its simulation, or control it");
    stream::Address address = stream::read_address(c, 0, c.parameters().texts("stream"));
    read_tls(c, c.parameters().texts("tls"), address);
    token_ = read_token_source(c.parameters().texts("token"));
    if (!token_.file.empty()) token_.file = c.resolve_path(token_.file);
    require_protection(address, token_.is_given());
    const std::string owner = item.robot ? std::string(item.robot->name) : "world";
    const std::string place = address.path.empty() ? std::to_string(address.port) : address.path;
    stream_.emplace(c, owner + "/jsonrpc:" + place, address, request_framing, limits);  // there may be several
  }

  void connect_by_name(Connector& c) override {
    const Parameters& p = c.parameters();
    Served served{SceneNames(*inspection_), *run_, read_grants(c, p.texts("write"))};
    for (const RobotView* robot : c.robots()) served.scene.add_robot(std::string(robot->name), robot->base());
    service_.emplace(std::move(served), static_cast<Outlet&>(*this));
    // in lockstep the clients make time go on
    if (stream_->address().lockstep.empty()) service_->set_time_in_a_step(time_in_a_step);
    constexpr std::string_view poses[] = {"*:pose"};
    const bool is_given = p.given("refresh");
    refresh(c, is_given ? p.texts("refresh") : std::span<const std::string_view>(poses), is_given, service_->scene());
  }

  void start() override {
    const bool opens = !stream_->is_replayed() && (!inputs_ || inputs_->may_open());
    if (token_.is_given() && opens) service_->set_token(read_token(token_));
    stream_->open();
    service_->time_was_set(run_->time());
  }
  void restored() override { service_->time_was_set(run_->time()); }
  void* find_extension(const ExtensionId& id) override {
    return id == PauseAttendant::id() ? static_cast<PauseAttendant*>(this) : nullptr;
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase whole[] = {{Phase::IndexSpace::whole}};
    return whole;
  }

  void finish() override { stream_->finish(); }

  void step(const Step& step, Range) override {
    service_->begin_step(step.time, std::llround(1e9 * step.dt));
    service_->answer_due();
    // In lockstep, time stands still until the client waits for something that takes time.
    do stream_->begin(step.time);
    while (serve_events() && !stream_->address().lockstep.empty() && !service_->is_waiting());
    service_->send_updates();
  }

 private:
  /// Returns whether there were any events.
  bool serve_events() {
    bool any = false;
    while (const stream::Event* event = stream_->next()) {
      any = true;
      switch (event->kind) {
        case stream::Event::Kind::connected:
          service_->connected(event->client);
          break;
        case stream::Event::Kind::message:
          service_->received(event->client, event->bytes);
          break;
        case stream::Event::Kind::disconnected:
          service_->disconnected(event->client);
          break;
      }
    }
    return any;
  }

  void attend() noexcept override {
    try {
      service_->begin_pause();
      service_->answer_due();
      stream_->poll(run_->time());
      serve_events();
      service_->send_updates();
      if (const auto pauser = service_->who_keeps_it_waiting()) tell_pause(*pauser);
    } catch (...) {  // no memory: the request is not answered
    }
  }

  void tell_pause(const Pauser& pauser) {
    char time[32];
    std::snprintf(time, sizeof time, "%.3f s", 1e-9 * double(run_->time()));
    host_->log(LogLevel::info, quote(stream_->name()) + ": the run stands at " + time + ", since client " +
                                   std::to_string(pauser.client) + " has paused it; it goes on when a client calls " +
                                   "`resume`" + (pauser.stays ? "" : ", or when that one goes"));
  }

  bool has_room(std::uint32_t client) const override { return stream_->waiting(client) <= most_for_requests; }
  bool has_room_for_updates(std::uint32_t client) const override {
    return stream_->waiting(client) <= most_for_updates;
  }
  bool send(std::uint32_t client, std::string_view line) override { return stream_->send(client, line); }
  bool send_update(std::uint32_t client, std::string_view line) override {
    return stream_->send(client, line, most_for_updates);
  }
  /// Marks the run as not repeatable. In a replay the recording makes the changes.
  void changed() override {
    ExternalInputs* const inputs = stream_->address().lockstep.empty() ? inputs_ : nullptr;
    if (inputs && !std::exchange(has_changed_, true))
      inputs->not_repeatable("clients of " + quote(stream_->name()) +
                             " have changed the state, and without lockstep the wall clock decides when");
  }
  void hold(std::uint32_t client, bool held) override { stream_->hold(client, held); }
  void answered() override { stream_->answered(); }
  void disconnect(std::uint32_t client) override { stream_->disconnect(client); }

  Inspection* inspection_ = nullptr;
  RunControl* run_ = nullptr;
  ExternalInputs* inputs_ = nullptr;
  Host* host_ = nullptr;
  bool has_changed_ = false;
  TokenSource token_;
  std::optional<stream::Stream> stream_;
  std::optional<Service> service_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<JsonRpc>(description)};

}  // namespace

MURO_PLUGIN(.name = "controller_jsonrpc", .version = description.version, .licence = "MIT",
            .summary = "JSON-RPC 2.0 for any property and the control of the run", .algorithms = algorithms)
