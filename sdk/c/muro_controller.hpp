// SPDX-License-Identifier: MIT
//
// Control code for muro as a C++20 class: muro_controller.h with members, spans and exceptions. No other part of muro
// is needed. Each robot has an object of the class, which may own memory. An exception that leaves one of its functions
// becomes an error message.
//
//     class Brake {
//      public:
//       static constexpr const char* name = "brake";
//       static constexpr const char* version = "1.0.0";
//       static constexpr const char* summary = "Stops before an obstacle ahead";
//       static constexpr muro_port inputs[] = {{"ranges", "m", 0, 0}};
//       static constexpr muro_port outputs[] = {{"command.twist", "m/s, rad/s", 6, 0}};
//
//       explicit Brake(const muro::controller::Setup& setup);
//       void step(const muro::controller::Step& now) {
//         const auto ranges = now.input(0);  // the middle ray looks ahead
//         now.output(0)[0] = ranges[ranges.size() / 2] > 1 ? 0.5 : 0;
//       }
//     };
//     MURO_CONTROLLER(Brake)
//
// A class may also have
//
//     static constexpr muro_tunable tunables[] = {...};                            // numbers that the scenario may set
//     static constexpr muro::controller::Task<Brake> tasks[] = {{"plan", 5, &Brake::plan}};  // name, Hz, function
//     static constexpr std::size_t save_size = 16;                                 // all three, for snapshots:
//     void save(muro::controller::Saver& to) const;                                // at most save_size bytes
//     void load(muro::controller::Loader& from);                                   // into a new object
#pragma once

#include <cstring>
#include <exception>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "muro_controller.h"

#ifdef __has_builtin
#if __has_builtin(__builtin_clear_padding)
#define MURO_CAN_CLEAR_PADDING
#endif
#endif

namespace muro::controller {

/// Writes log lines. To be used within functions of the object that it was given to.
class Log {
 public:
  explicit Log(const muro_log_sink* log) : log_(log) {}
  void debug(const std::string& text) const { muro_write_log(log_, MURO_LOG_DEBUG, text.c_str()); }
  void info(const std::string& text) const { muro_write_log(log_, MURO_LOG_INFO, text.c_str()); }
  void warning(const std::string& text) const { muro_write_log(log_, MURO_LOG_WARNING, text.c_str()); }
  void error(const std::string& text) const { muro_write_log(log_, MURO_LOG_ERROR, text.c_str()); }

 private:
  const muro_log_sink* log_;
};

/// The values that an object gets when it is created. Valid during the constructor.
class Setup {
 public:
  explicit Setup(const muro_controller_setup& raw) : raw_(raw) {}

  std::string_view robot() const { return raw_.robot; }
  double period() const { return raw_.period; }       ///< s between steps
  std::uint64_t seed() const { return raw_.seed; }    ///< from the simulation's seed and the robot's name
  std::uint32_t index() const { return raw_.index; }  ///< index of this object among those of the controller, from 0
  std::uint32_t count() const { return raw_.count; }  ///< number of these objects
  /// Number of elements of input `i`, an index in `inputs`; for a list the present number.
  std::uint32_t input_size(std::size_t i) const { return raw_.input_sizes[i]; }
  std::uint32_t output_size(std::size_t i) const { return raw_.output_sizes[i]; }
  double tunable(std::size_t i) const { return raw_.tunables[i]; }  ///< an index in `tunables`
  /// Returns the text after "name=" in the arguments of the scenario, or `otherwise`.
  std::string_view argument(std::string_view name, std::string_view otherwise = {}) const {
    for (const char* const* a = raw_.arguments; *a; ++a) {
      const std::string_view text = *a;
      if (text.size() > name.size() && text.substr(0, name.size()) == name && text[name.size()] == '=')
        return text.substr(name.size() + 1);
    }
    return otherwise;
  }
  Log log() const { return Log(raw_.log); }  ///< valid as long as the object
  const muro_controller_setup& raw() const { return raw_; }

 private:
  const muro_controller_setup& raw_;
};

/// One step. Inputs, outputs and tunables are given by their index in the lists of the class. Valid during the step.
class Step {
 public:
  explicit Step(const muro_controller_step& raw) : raw_(raw) {}

  double time() const { return raw_.time; }           ///< s since the start of the simulation
  double period() const { return raw_.period; }       ///< s between calls of this function
  std::uint64_t index() const { return raw_.index; }  ///< number of earlier runs of the controller
  std::span<const double> input(std::size_t i) const { return {raw_.inputs[i], raw_.input_sizes[i]}; }
  std::span<const std::int64_t> integer_input(std::size_t i) const {
    return {raw_.integer_inputs[i], raw_.input_sizes[i]};
  }
  std::string_view text_input(std::size_t i) const { return raw_.text_inputs[i]; }
  std::span<double> output(std::size_t i) const { return {raw_.outputs[i], raw_.output_sizes[i]}; }
  std::span<std::int64_t> integer_output(std::size_t i) const {
    return {raw_.integer_outputs[i], raw_.output_sizes[i]};
  }
  /// Sets a text output; a text that is too long is cut.
  void set_text_output(std::size_t i, std::string_view text) const {
    const std::size_t size = text.size() < raw_.output_sizes[i] ? text.size() : raw_.output_sizes[i] - 1;
    std::memcpy(raw_.text_outputs[i], text.data(), size);
    raw_.text_outputs[i][size] = 0;
  }
  double tunable(std::size_t i) const { return raw_.tunables[i]; }
  Log log() const { return Log(raw_.log); }
  const muro_controller_step& raw() const { return raw_; }

 private:
  const muro_controller_step& raw_;
};

/// Collects the saved bytes, up to save_size.
class Saver {
 public:
  explicit Saver(std::span<std::byte> room) : room_(room) {}

  /// Saves a value of a type without pointers. Compilers that can clear bytes of padding (GCC from 11 on) save them as
  /// zeros; with others the type must have no padding, so that equal states are equal byte by byte.
  template <class T>
  void put(const T& value) {
#ifdef MURO_CAN_CLEAR_PADDING
    static_assert(std::is_trivially_copyable_v<T>, "save numbers, or structs of numbers");
    alignas(T) std::byte bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    T* const cleared = reinterpret_cast<T*>(bytes);
    __builtin_clear_padding(cleared);
    put(std::span<const T>(cleared, 1));
#else
    put(std::span<const T>(&value, 1));
#endif
  }
  /// Saves the elements, not their number. The type must have no pointers and no padding.
  template <class T>
  void put(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>, "save numbers, or structs of numbers");
    if (values.size_bytes() > room_.size() - used_) throw std::length_error("more is saved than save_size bytes");
    if (!values.empty()) std::memcpy(room_.data() + used_, values.data(), values.size_bytes());
    used_ += values.size_bytes();
  }
  std::size_t used() const { return used_; }  ///< bytes

 private:
  std::span<std::byte> room_;
  std::size_t used_ = 0;
};

/// Returns what was put into a Saver, in the same order.
class Loader {
 public:
  explicit Loader(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <class T>
  T get() {
    T value;
    get(std::span<T>(&value, 1));
    return value;
  }
  template <class T>
  void get(std::span<T> values) {
    static_assert(std::is_trivially_copyable_v<T>, "load numbers, or structs of numbers");
    if (values.size_bytes() > rest_.size()) throw std::length_error("less was saved than is loaded");
    if (!values.empty()) std::memcpy(values.data(), rest_.data(), values.size_bytes());
    rest_ = rest_.subspan(values.size_bytes());
  }
  std::size_t left() const { return rest_.size(); }  ///< bytes

 private:
  std::span<const std::byte> rest_;
};

/// A function of a class that runs less often than `step`.
template <class Controller>
struct Task {
  const char* name;
  double rate;  ///< Hz; the controller's rate divided by a whole number
  void (Controller::*function)(const Step&);
};

namespace detail {

inline void set_error(char* error, std::size_t size, const char* text) {
  if (size == 0) return;
  const std::size_t length = strnlen(text, size - 1);
  std::memcpy(error, text, length);
  error[length] = 0;
}

/// Calls `function`; returns 0, or 1 with the text of the exception.
template <class Function>
int guarded(char* error, std::size_t size, Function function) noexcept {
  try {
    function();
    return 0;
  } catch (const std::exception& e) {
    set_error(error, size, e.what());
  } catch (...) {
    set_error(error, size, "an exception that is no std::exception");
  }
  return 1;
}

/// The functions of the C interface for a class.
template <class C>
struct Functions {
  static void* instantiate(const muro_controller_setup* setup, char* error, std::size_t size) noexcept {
    C* made = nullptr;
    guarded(error, size, [&] { made = new C(Setup(*setup)); });
    return made;
  }
  static void destroy(void* instance) noexcept { delete static_cast<C*>(instance); }
  static int step(void* instance, const muro_controller_step* now, char* error, std::size_t size) noexcept {
    return guarded(error, size, [&] { static_cast<C*>(instance)->step(Step(*now)); });
  }
  template <std::size_t I>
  static int task(void* instance, const muro_controller_step* now, char* error, std::size_t size) noexcept {
    return guarded(error, size, [&] { (static_cast<C*>(instance)->*(C::tasks[I].function))(Step(*now)); });
  }
  static int save(void* instance, void* to, std::size_t* bytes, char* error, std::size_t size) noexcept {
    return guarded(error, size, [&] {
      Saver saver({static_cast<std::byte*>(to), *bytes});
      static_cast<const C*>(instance)->save(saver);
      *bytes = saver.used();
    });
  }
  static int load(void* instance, const void* from, std::size_t bytes, char* error, std::size_t size) noexcept {
    return guarded(error, size, [&] {
      Loader loader({static_cast<const std::byte*>(from), bytes});
      static_cast<C*>(instance)->load(loader);
    });
  }
};

template <class C, std::size_t... I>
const muro_task* tasks_of(std::index_sequence<I...>) {
  static constexpr muro_task tasks[] = {{C::tasks[I].name, C::tasks[I].rate, &Functions<C>::template task<I>}...};
  return tasks;
}

template <class C>
muro_controller_table make_table() {
  using F = Functions<C>;
  muro_controller_table t{};
  t.abi = MURO_CONTROLLER_ABI;
  t.table_size = sizeof t;
  t.name = C::name;
  t.version = C::version;
  t.summary = C::summary;
  if constexpr (requires { C::inputs; }) t.inputs = C::inputs, t.input_count = std::uint32_t(std::size(C::inputs));
  if constexpr (requires { C::outputs; }) t.outputs = C::outputs, t.output_count = std::uint32_t(std::size(C::outputs));
  if constexpr (requires { C::tunables; })
    t.tunables = C::tunables, t.tunable_count = std::uint32_t(std::size(C::tunables));
  if constexpr (requires { C::tasks; }) {
    t.tasks = tasks_of<C>(std::make_index_sequence<std::size(C::tasks)>());
    t.task_count = std::uint32_t(std::size(C::tasks));
  }
  t.step = &F::step;
  t.instantiate = &F::instantiate;
  t.destroy = &F::destroy;
  if constexpr (requires { C::save_size; }) t.save_size = C::save_size, t.save = &F::save, t.load = &F::load;
  return t;
}

}  // namespace detail

/// Returns the table of a class.
template <class C>
const muro_controller_table* table_of() {
  static const muro_controller_table table = detail::make_table<C>();
  return &table;
}

}  // namespace muro::controller

/// Makes a class the control code of this library. To be used once, outside of namespaces.
#define MURO_CONTROLLER(CLASS) \
  const muro_controller_table* muro_controller(void) { return muro::controller::table_of<CLASS>(); }
