// SPDX-License-Identifier: MIT
// Commands the speed of a robot by the clock. The command is an output of its own, which other control code reads.
#include <array>
#include <optional>
#include <stdexcept>
#include <string>

#include "muro_controller.hpp"
#include "words.hpp"

namespace {

using namespace muro::controller;

/// Part of the tour: begins at a simulated time (s), with m/s, m/s and rad/s in the axes of the base.
struct Leg {
  double from = 0, forward = 0, left = 0, turn = 0;
};

class Tour {
 public:
  static constexpr const char* name = "tour";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Commands a velocity that depends on time";
  static constexpr muro_port outputs[] = {{"command.twist", "m/s, rad/s", 6, MURO_PORT_OWN}};
  static constexpr std::size_t save_size = sizeof(double);

  explicit Tour(const Setup& setup) {
    const std::string_view text = setup.argument("plan");
    std::array<double, 4 * most> numbers{};
    std::size_t count = 0;
    quadruped::for_words(text, [&](std::string_view word) {
      if (count == numbers.size()) throw std::invalid_argument("argument `plan` has more than 64 parts");
      const std::optional<double> number = quadruped::number_of(word);
      if (!number) throw std::invalid_argument("argument `plan`: \"" + std::string(word) + "\" is no number");
      numbers[count++] = *number;
    });
    if (count == 0 || count % 4 != 0)
      throw std::invalid_argument(
          "argument `plan` is a list of time (s), forward, left (m/s) and turn (rad/s): \"0 0.5 0 0, 4 0 0 0\"");
    for (std::size_t i = 0; i < count; i += 4) {
      legs_[count_++] = {numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]};
      if (count_ > 1 && legs_[count_ - 1].from <= legs_[count_ - 2].from)
        throw std::invalid_argument("argument `plan`: times rise from part to part");
    }
  }

  void step(const Step& now) {
    const auto twist = now.output(0);
    while (begun_ < double(count_) && now.time() >= legs_[std::size_t(begun_)].from) begun_ += 1;
    const Leg leg = begun_ == 0 ? Leg{} : legs_[std::size_t(begun_) - 1];
    twist[0] = leg.forward, twist[1] = leg.left, twist[5] = leg.turn;
  }

  void save(Saver& to) const { to.put(begun_); }
  void load(Loader& from) { begun_ = from.get<double>(); }

 private:
  static constexpr std::size_t most = 64;
  std::array<Leg, most> legs_{};
  std::size_t count_ = 0;
  double begun_ = 0;  // number of parts that have begun
};

}  // namespace

MURO_CONTROLLER(Tour)
