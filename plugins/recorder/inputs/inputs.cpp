// SPDX-License-Identifier: MIT
// Records all inputs from outside a simulation, and replays them; see README.md.
#include <array>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <optional>
#include <tuple>

#include "muro/base/whole_file.hpp"
#include "muro/ext/outputs.hpp"
#include "muro/plugin.hpp"
#include "plugins/common/text/quote.hpp"
#include "recording.hpp"

namespace {

using namespace muro;
using namespace muro::inputs;

constexpr Parameter recorder_parameters[] = {
    text("file", "", "where to write; a relative path starts in the working directory").required(),
};
constexpr Description recorder{
    .id = "recorder.inputs",
    .kind = Kind::recorder,
    .version = "1.0.0",
    .summary = "Writes all that comes from outside, with the instants at which it takes effect, to a file",
    .parameters = recorder_parameters,
    .capabilities = deterministic | restorable,
};

constexpr Parameter replay_parameters[] = {
    text("file", "", "a recording of recorder.inputs; a relative path starts beside the scenario").required(),
};
constexpr Description replay{
    .id = "controller.replay",
    .kind = Kind::controller,
    .version = "1.0.0",
    .summary = "A recording of recorder.inputs takes the place of all clients and programs outside",
    .parameters = replay_parameters,
    .capabilities = deterministic | restorable,
};

ExternalInputs& inputs_of(Host& host) {
  ExternalInputs* inputs = ExternalInputs::of(host);
  if (!inputs) throw Error("this host does not tell of inputs from outside");
  return *inputs;
}

class InputRecorder final : public Algorithm, private InputSink {
 public:
  ~InputRecorder() override {
    if (inputs_ && is_sink_) inputs_->set_sink(nullptr);
    if (file_ && !has_begun_) file_->discard();  // the run has not begun: there is nothing but a header
  }

  void connect(Connector& c) override {
    std::error_code code;
    const std::string file(c.parameters().text("file"));
    path_ = std::filesystem::absolute(file, code).string();
    if (code) throw Error("file " + quote(file) + " cannot be written: the working directory is not there any more");
    if (Outputs* outputs = Outputs::of(c.host())) outputs->file(path_);
    inputs_ = &inputs_of(c.host());
    is_sink_ = inputs_->set_sink(this);
    if (!is_sink_) throw Error("there is another recorder.inputs already; one records all");
  }

  void start() override {
    if (file_) return;  // a reset is a part of the recorded run
    file_.emplace(path_, WholeFileOptions{.keep_unpublished = true});
    file_->write(header_line(inputs_->initial_hash()));
  }

  void step(const Step&, Range) override {
    has_begun_ = true;
    flush();
  }

  void finish() override {
    flush();
    file_->write(end_line({inputs_->epoch(), inputs_->time(), inputs_->robots_hash()}));
    file_->publish();
  }

 private:
  void take(const RecordedInput& input) noexcept override {
    const std::lock_guard lock(mutex_);
    add_line(lines_, input);
  }

  void flush() {
    {
      const std::lock_guard lock(mutex_);
      written_.swap(lines_);
    }
    if (!written_.empty()) file_->write(written_);
    written_.clear();
  }

  std::string path_;
  ExternalInputs* inputs_ = nullptr;
  bool is_sink_ = false;
  std::optional<WholeFile> file_;
  std::mutex mutex_;  ///< guards lines_
  std::string lines_, written_;
  bool has_begun_ = false;
};

class InputReplay final : public Algorithm {
 public:
  void connect(Connector& c) override {
    const std::string path(c.resolve_path(c.parameters().text("file")));
    Recording recording = read_recording(path);
    host_ = &c.host();
    inputs_ = &inputs_of(c.host());
    if (!inputs_->set_recording(recording.inputs))
      throw Error("there is another controller.replay already; one recording is replayed at a time");
    path_ = path;
    initial_hash_ = recording.initial_hash;
    end_ = recording.end;
    if (!end_)
      c.host().log(LogLevel::warning,
                   "the recording " + quote(path) +
                       " has no end: its run was broken off, so the end of this one cannot be compared");
  }

  void start() override {
    if (inputs_->initial_hash() != initial_hash_)
      throw Error("the recording " + quote(path_) +
                  " is of another scenario: the state at the start is not the same; replay it with the scenario, the "
                  "settings and the seed that it was made with");
  }

  void step(const Step&, Range) override {}

  /// Compares the end of this run with the end of the recorded run.
  void finish() override {
    if (!end_) return;
    const auto end = std::tuple(end_->epoch, end_->time), now = std::tuple(inputs_->epoch(), inputs_->time());
    if (now < end) {
      tell_of_another_end("ends earlier");
      return;
    }
    std::string_view channel;
    if (const std::uint64_t unused = inputs_->unused(channel); unused > 0)
      throw Error(std::to_string(unused) + " inputs of the recording " + quote(path_) +
                  " were not taken by anyone, the first of channel " + quote(channel) +
                  "; is the algorithm that took them in the scenario, at the same rate?");
    if (end < now) {
      tell_of_another_end("has gone on");
      return;
    }
    if (end_->robots_hash != inputs_->robots_hash())
      throw Error("the replay of " + quote(path_) + " ended in another state than the recorded run");
    host_->log(LogLevel::info, "the replay ended in the recorded state");
  }

 private:
  void tell_of_another_end(const char* what_this_run_does) const {
    std::array<char, 64> time{};
    std::snprintf(time.data(), time.size(), "%.9g s", 1e-9 * double(end_->time));
    host_->log(LogLevel::info, std::string("the recorded run ended at t = ") + time.data() +
                                   (end_->epoch > 0 ? " of epoch " + std::to_string(end_->epoch) : "") + "; this one " +
                                   what_this_run_does + ", so their ends are not compared");
  }

  std::string path_;
  Host* host_ = nullptr;
  ExternalInputs* inputs_ = nullptr;
  std::uint64_t initial_hash_ = 0;
  std::optional<RunEnd> end_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<InputRecorder>(recorder), algorithm<InputReplay>(replay)};

}  // namespace

MURO_PLUGIN(.name = "recorder_inputs", .version = recorder.version, .licence = "MIT",
            .summary = "What comes from outside, recorded and replayed", .algorithms = algorithms)
