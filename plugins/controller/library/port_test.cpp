// SPDX-License-Identifier: MIT
#include "port.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace muro::control {
namespace {

template <class T>
struct Place {
  T value;
  KeyInfo key{"test", "1", &value_type<T>, Role::state, ""};
  FoundProperty found{ObjectId{1}, &key, Multiplicity::single, 1};
};

template <class T>
Port port_to(Place<T>& place) {
  Port port;
  port.add(place.found, &place.value);
  port.resolve();
  return port;
}

template <class T>
void holds(T written) {
  Place<T> place{written};
  const Port port = port_to(place);
  double number = 0;
  port.read(&number);
  EXPECT_EQ(number, double(written)) << value_type<T>.name;
  place.value = T(1);
  std::uint32_t bad = 0;
  EXPECT_TRUE(port.write(&number, bad)) << value_type<T>.name;
  EXPECT_EQ(place.value, written) << value_type<T>.name;
}

TEST(Port, CarriesEveryTypeOfNumberThereAndBack) {
  holds<double>(-0.1);
  holds<float>(-0.1f);
  holds<std::int64_t>(-(std::int64_t(1) << 53));
  holds<std::int32_t>(std::numeric_limits<std::int32_t>::min());
  holds<std::int32_t>(std::numeric_limits<std::int32_t>::max());
  holds<std::uint64_t>(std::uint64_t(1) << 53);
  holds<std::uint32_t>(std::numeric_limits<std::uint32_t>::max());
  holds<std::uint8_t>(255);
}

template <class T>
void refuses(double number) {
  Place<T> place{T(7)};
  std::uint32_t bad = 9;
  EXPECT_FALSE(port_to(place).write(&number, bad)) << value_type<T>.name << " " << number;
  EXPECT_EQ(bad, 0u);
  EXPECT_EQ(place.value, T(7)) << value_type<T>.name << " " << number;
}

TEST(Port, RefusesNumbersThatDoNotFitAndLeavesThePropertyAsItWas) {
  refuses<std::uint8_t>(-0.51);
  refuses<std::uint8_t>(255.51);
  refuses<std::int32_t>(2147483648.0);
  refuses<std::int32_t>(-2147483649.0);
  refuses<std::uint32_t>(4294967296.0);
  refuses<std::int64_t>(9223372036854775808.0);
  refuses<std::uint64_t>(18446744073709551616.0);
  refuses<std::uint64_t>(-1);
  refuses<std::uint8_t>(std::nan(""));
  refuses<float>(1e39);
}

TEST(Port, RoundsToWholeNumbersWhereThePropertyHoldsSuch) {
  Place<std::uint8_t> place{0};
  std::uint32_t bad = 0;
  for (const auto& [number, expected] : {std::pair{254.5, 254}, {254.51, 255}, {-0.4, 0}, {2.5, 2}, {3.5, 4}}) {
    EXPECT_TRUE(port_to(place).write(&number, bad));
    EXPECT_EQ(place.value, expected) << number;
  }
}

TEST(Port, NeedsNoCopyOfOneRunOfDoubles) {
  Place<Twist> twist{Twist{{1, 2, 3}, {4, 5, 6}}};
  const Port port = port_to(twist);
  EXPECT_EQ(port.size(), 6u);
  EXPECT_EQ(port.direct(), twist.value.linear.data());
  EXPECT_EQ(static_cast<double*>(port.direct())[5], 6);
  Place<float> small{0};
  EXPECT_EQ(port_to(small).direct(), nullptr);
}

TEST(Port, WritesTextsThatFitTheirProperty) {
  std::uint8_t bytes[6] = {9, 9, 9, 9, 9, 9};
  ArrayHeader array{bytes, 4};
  Place<std::uint8_t> place{};
  place.found.multiplicity = Multiplicity::array;
  Port port(PortType::text, 8);
  port.add(place.found, &array);
  port.resolve();
  EXPECT_FALSE(port.has_room_for_text());
  std::uint32_t bad = 0;
  EXPECT_TRUE(port.write("ab\0cdefg", bad));
  EXPECT_EQ(std::vector<int>(bytes, bytes + 6), (std::vector<int>{'a', 'b', 0, 0, 9, 9}));
  EXPECT_TRUE(port.write("four\0fgh", bad)) << "the end of the property is the end of the text";
  EXPECT_FALSE(port.write("fives\0gh", bad));
  EXPECT_FALSE(port.write("no zero.", bad));
  EXPECT_EQ(std::vector<int>(bytes, bytes + 6), (std::vector<int>{'f', 'o', 'u', 'r', 9, 9}));
}

TEST(Port, IsAtRestWithoutSpeedAndEffort) {
  Place<double> speed{2}, angle{3}, torque{4};
  speed.key.unit = "rad/s or m/s", angle.key.unit = "rad or m", torque.key.unit = "N m or N";
  Port port;
  for (Place<double>* p : {&speed, &angle, &torque}) port.add(p->found, &p->value);
  port.resolve();
  port.rest();
  EXPECT_EQ(speed.value, 0);
  EXPECT_EQ(angle.value, 3);
  EXPECT_EQ(torque.value, 0);
}

TEST(Port, SetsPropertiesSideBySide) {
  Place<Vec3> first{Vec3(1, 2, 3)};
  Place<std::int32_t> second{4};
  std::uint8_t bytes[] = {5, 6};
  ArrayHeader array;  // its address and length are set later
  Place<std::uint8_t> third{};
  third.found.multiplicity = Multiplicity::array;
  Port port;
  port.add(first.found, &first.value);
  port.add(second.found, &second.value);
  port.add(third.found, &array);
  array = {bytes, 2};
  port.resolve();
  ASSERT_EQ(port.size(), 6u);
  EXPECT_EQ(port.direct(), nullptr);
  double numbers[6];
  port.read(numbers);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(numbers[i], i + 1);
  for (double& n : numbers) n = -n;
  std::uint32_t bad = 0;
  EXPECT_FALSE(port.write(numbers, bad));
  EXPECT_EQ(bad, 4u) << "the first of the bytes";
  EXPECT_EQ(first.value, Vec3(1, 2, 3)) << "nothing is written when one does not fit";
  EXPECT_EQ(second.value, 4);
  numbers[4] = numbers[5] = 7;
  EXPECT_TRUE(port.write(numbers, bad));
  EXPECT_EQ(first.value, Vec3(-1, -2, -3));
  EXPECT_EQ(bytes[1], 7);
}

TEST(Port, ReadsAFollowerAsItsLeaderSaysAndWritesNothingForIt) {
  Place<double> leader{0.5}, last{7};
  Port port;
  port.add_follower(1, -2, 0.25);
  port.add(leader.found, &leader.value);
  port.add(last.found, &last.value);
  port.resolve();
  ASSERT_EQ(port.size(), 3u);
  double numbers[3];
  EXPECT_EQ(port.read(numbers), 3u);
  EXPECT_EQ(numbers[0], 0.25 - 2 * 0.5);
  EXPECT_EQ(numbers[1], 0.5);
  EXPECT_EQ(numbers[2], 7);
  const double written[] = {9, 0.125, 8};
  std::uint32_t bad = 0;
  EXPECT_TRUE(port.write(written, bad));
  EXPECT_EQ(leader.value, 0.125);
  EXPECT_EQ(last.value, 8);
  const double wrong[] = {9, 0.125, std::nan("")};
  EXPECT_FALSE(port.write(wrong, bad));
  EXPECT_EQ(bad, 2u) << "places are counted with it";
  port.rest();
  EXPECT_EQ(leader.value, 0.125);
}

}  // namespace
}  // namespace muro::control
