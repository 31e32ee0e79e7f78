// SPDX-License-Identifier: MIT
#include "unit.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "muro/vocabulary.hpp"

namespace muro::fmu {
namespace {

TEST(Unit, KnowsProductsOfSiUnits) {
  EXPECT_EQ(exponents_of("m/s"), (Exponents{0, 1, -1}));
  EXPECT_EQ(exponents_of("kg m^2"), (Exponents{1, 2}));
  EXPECT_EQ(exponents_of("m/s^2"), exponents_of("m.s-2"));
  EXPECT_EQ(exponents_of("N m"), exponents_of("N.m"));
  EXPECT_EQ(exponents_of("N m"), exponents_of("J"));
  EXPECT_EQ(exponents_of("rad/s"), (Exponents{0, 0, -1, 0, 0, 0, 0, 1}));
  EXPECT_EQ(exponents_of("1"), Exponents{});
  EXPECT_EQ(exponents_of("1/s"), exponents_of("Hz"));
  for (const char* none : {"", "px", "furlong", "m/", "m^^2", "m^999", "(m)", "m2000000000000"})
    EXPECT_EQ(exponents_of(none), std::nullopt) << none;
}

TEST(Unit, OfEachScalarOfAProperty) {
  EXPECT_EQ(unit_of_scalar(keys::twist, 2, false), "m/s");
  EXPECT_EQ(unit_of_scalar(keys::twist, 3, false), "rad/s");
  EXPECT_EQ(unit_of_scalar(keys::external_wrench, 0, false), "N");
  EXPECT_EQ(unit_of_scalar(keys::external_wrench, 5, false), "N m");
  EXPECT_EQ(unit_of_scalar(keys::pose, 2, false), "m");
  EXPECT_EQ(unit_of_scalar(keys::pose, 3, false), "1");
  EXPECT_EQ(unit_of_scalar(keys::inertial, 0, false), "kg");
  EXPECT_EQ(unit_of_scalar(keys::inertial, 3, false), "m");
  EXPECT_EQ(unit_of_scalar(keys::inertial, 9, false), "kg m^2");
  EXPECT_EQ(unit_of_scalar(keys::joint_velocity, 0, false), "rad/s");
  EXPECT_EQ(unit_of_scalar(keys::joint_velocity, 0, true), "m/s");
  EXPECT_EQ(unit_of_scalar(keys::joint_effort, 0, true), "N");
  EXPECT_EQ(unit_of_scalar(keys::ranges, 0, false), "m");
}

TEST(Unit, ConvertsBetweenUnitsOfOneQuantity) {
  const Unit degree{"deg", BaseUnit{{0, 0, 0, 0, 0, 0, 0, 1}, std::numbers::pi / 180, 0}};
  const auto to_rad = conversion(degree, false, "rad");
  ASSERT_TRUE(to_rad);
  EXPECT_DOUBLE_EQ(to_rad->to_property(180), std::numbers::pi);
  EXPECT_DOUBLE_EQ(to_rad->to_fmu(std::numbers::pi / 2), 90);
  const Unit celsius{"degC", BaseUnit{{0, 0, 0, 0, 1}, 1, 273.15}};
  EXPECT_DOUBLE_EQ(conversion(celsius, false, "K")->to_property(20), 293.15);
  EXPECT_DOUBLE_EQ(conversion(celsius, false, "K")->to_fmu(293.15), 20);
  EXPECT_EQ(conversion(celsius, true, "K")->to_property(20), 20) << "a difference of temperatures";
}

TEST(Unit, ChangesNoBitWhereUnitsAreTheSame) {
  const Unit metre{"m", BaseUnit{{0, 1}, 1, 0}};
  ASSERT_TRUE(conversion(metre, false, "m"));
  EXPECT_TRUE(conversion(metre, false, "m")->is_identity());
  EXPECT_TRUE(conversion({"N.m", {}}, false, "N m")->is_identity());
  EXPECT_TRUE(conversion({"px", {}}, false, "px")->is_identity());
}

TEST(Unit, RefusesOtherQuantitiesAndUnitsThatNobodyDefines) {
  const Unit metre{"m", BaseUnit{{0, 1}, 1, 0}};
  EXPECT_FALSE(conversion(metre, false, "m/s"));
  EXPECT_FALSE(conversion(metre, false, "1"));
  EXPECT_FALSE(conversion({"1", BaseUnit{}}, false, "m"));
  EXPECT_FALSE(conversion({"deg", {}}, false, "rad"));
  EXPECT_FALSE(conversion({"Hz", {}}, false, "rad/s"));
  const Unit bare_radian{"rad", BaseUnit{}};  // form that some tools write
  EXPECT_TRUE(conversion(bare_radian, false, "rad"));
}

}  // namespace
}  // namespace muro::fmu
