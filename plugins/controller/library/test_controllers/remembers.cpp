// SPDX-License-Identifier: MIT
// Control code with its own memory: drives at the mean of the remembered values, and reports its counts.
#include <atomic>
#include <numeric>
#include <vector>

#include "muro_controller.hpp"

namespace {

using muro::controller::Setup;
using muro::controller::Step;

class Remembers {
 public:
  static constexpr const char* name = "remembers";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Drives by what it remembers";
  static constexpr muro_port inputs[] = {{"pose", "m", 7, 0}};
  static constexpr muro_port outputs[] = {{"command.twist", "m/s, rad/s", 6, 0},
                                          {"remembers.count", "1", 2, MURO_PORT_OWN | MURO_PORT_INTEGER},
                                          {"remembers.status", "1", 12, MURO_PORT_OWN | MURO_PORT_TEXT}};
  static constexpr muro_tunable tunables[] = {{"speed", "m/s", 0.5, 0.1, 2, "at the start"},
                                              {"gain", nullptr, 1, 0, 0, "of the mean"}};

  explicit Remembers(const Setup& setup) : log_(setup.log()) {
    if (setup.argument("fail") == "create") throw std::invalid_argument("this robot shall not be");
    fails_at_ = setup.argument("fail") == "step" ? 3 : 0;
    seen_.push_back(setup.tunable(0));
    ++alive;
    if (!setup.argument("tell").empty())
      log_.info("number " + std::to_string(setup.index()) + " of " + std::to_string(setup.count()) + ", " +
                std::to_string(alive) + " alive");
  }
  ~Remembers() { --alive; }
  Remembers(const Remembers&) = delete;
  Remembers& operator=(const Remembers&) = delete;

  void plan(const Step& now) {
    ++plans_;
    log_.debug("plan at " + std::to_string(now.time()) + " every " + std::to_string(now.period()));
  }
  static constexpr muro::controller::Task<Remembers> tasks[] = {{"plan", 2.5, &Remembers::plan}};

  void step(const Step& now) {
    ++steps_;
    if (steps_ == fails_at_) throw std::runtime_error("it has forgotten everything");
    seen_.push_back(seen_.back() + 0.01 * now.input(0)[0]);
    const double mean = std::accumulate(seen_.begin(), seen_.end(), 0.0) / double(seen_.size());
    now.output(0)[0] = now.tunable(1) * mean;
    now.integer_output(1)[0] = steps_;
    now.integer_output(1)[1] = plans_;
    now.set_text_output(2, "step " + std::to_string(steps_) + (steps_ > 20 ? " of a long way" : ""));
  }

#ifndef WITHOUT_SAVE
  static constexpr std::size_t save_size = 4096;
  void save(muro::controller::Saver& to) const {
    to.put(steps_);
    to.put(plans_);
    to.put(seen_.size());
    to.put(std::span(seen_));
  }
  void load(muro::controller::Loader& from) {
    steps_ = from.get<std::int64_t>();
    plans_ = from.get<std::int64_t>();
    seen_.resize(from.get<std::size_t>());
    from.get(std::span(seen_));
    if (from.left() > 0) throw std::length_error("more was saved than is loaded");
  }
#endif

 private:
  static inline std::atomic<int> alive{0};
  muro::controller::Log log_;
  std::vector<double> seen_;
  std::int64_t steps_ = 0, plans_ = 0, fails_at_ = 0;
};

}  // namespace

MURO_CONTROLLER(Remembers)
