// SPDX-License-Identifier: MIT
// The base of algorithms that serve one robot after the other.
#pragma once

#include <span>
#include <vector>

#include "muro/algorithm.hpp"
#include "muro/ext/call_note.hpp"

namespace muro {

/// Lists of which each robot has one, such as lists of its wheels. They are all in one array, in the order of robots,
/// so that a step goes through memory from front to back.
template <class T>
class PackedLists {
 public:
  /// Adds a list and returns its position. [setup]
  Range add(const std::vector<T>& list) {
    const auto begin = std::uint32_t(all_.size());
    all_.insert(all_.end(), list.begin(), list.end());
    return {begin, std::uint32_t(all_.size())};
  }
  std::span<T> operator[](Range list) { return {all_.data() + list.begin, list.end - list.begin}; }
  std::span<const T> operator[](Range list) const { return {all_.data() + list.begin, list.end - list.begin}; }

 private:
  std::vector<T> all_;
};

/// Elements for a range-based for loop that notes the present element.
template <class T>
class NotedSpan {
 public:
  class Iterator {
   public:
    T& operator*() const { return *at_; }
    Iterator& operator++() {
      ++at_, ++item_;
      tell();
      return *this;
    }
    bool operator!=(const Iterator& other) const { return at_ != other.at_; }

   private:
    friend NotedSpan;
    Iterator(T* at, const T* end, std::uint32_t item, CallNote* note) : at_(at), end_(end), item_(item), note_(note) {
      tell();
    }
    void tell() const {
      if (note_) note_->set_item(at_ != end_ ? item_ : CallNote::no_item);
    }
    T* at_;
    const T* end_;
    std::uint32_t item_;
    CallNote* note_;
  };

  /// `note` may be null. `all`: elements of the instance; `range`: those to visit.
  NotedSpan(T* all, Range range, CallNote* note) : all_(all), range_(range), note_(note) {}
  Iterator begin() const { return {all_ + range_.begin, all_ + range_.end, range_.begin, note_}; }
  Iterator end() const { return {all_ + range_.end, all_ + range_.end, range_.end, nullptr}; }

 private:
  T* all_;
  Range range_;
  CallNote* note_;
};

/// An algorithm that writes properties of each robot from properties of the same robot only (or see
/// set_reads_other_robots), so that robots may be divided among threads. `Robot` holds the data of one robot: handles
/// and parameters. A derived class only has to connect one robot, and to make a step over `robots(range)`.
template <class Robot>
class PerRobotAlgorithm : public Algorithm {
 public:
  void connect(Connector& c) final {
    read_parameters(c.parameters());
    notes_ = CallNotes::of(c.host());
    robots_.reserve(c.items().size());
    CallNote* const noted = note();
    for (const Item& item : c.items()) {
      if (noted) noted->set_item(std::uint32_t(robots_.size()));
      if (!item.robot) throw Error("it serves robots, but no robot is named");
      robots_.push_back(connect_robot(c, item));
    }
  }

  std::span<const Phase> phases() const final {
    static constexpr Phase own[] = {{Phase::IndexSpace::items, Phase::Scope::own_robot}};
    static constexpr Phase all[] = {{Phase::IndexSpace::items, Phase::Scope::reads_all}};
    return scope_ == Phase::Scope::own_robot ? own : all;
  }

 protected:
  /// Reads parameters that are equal for all robots; called before the first one is connected. [setup]
  virtual void read_parameters(const Parameters& parameters) { static_cast<void>(parameters); }
  /// Binds every property of one robot; `item.robot` is not null. [setup]
  virtual Robot connect_robot(Connector& connector, const Item& item) = 0;

  /// Declares that steps of a robot read properties of other robots too; call in connect_robot. [setup]
  void set_reads_other_robots() { scope_ = Phase::Scope::reads_all; }

  /// The robots of the items of `range`, for a loop; messages about a failed call name the present robot. [step]
  NotedSpan<Robot> robots(Range range) { return {robots_.data(), range, note()}; }
  Robot& robot(std::uint32_t item) { return robots_[item]; }

 private:
  CallNote* note() const { return notes_ ? &notes_->of_this_thread() : nullptr; }

  std::vector<Robot> robots_;  ///< one for each item
  CallNotes* notes_ = nullptr;
  Phase::Scope scope_ = Phase::Scope::own_robot;
};

}  // namespace muro
