// SPDX-License-Identifier: MIT
// Files of parts: compares the parts of the plugin with their data sheets, and checks the messages about mistakes.
#include "part.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "muro/algorithm.hpp"
#include "parameters.hpp"
#include "tests/support/complaint.hpp"

namespace muro {
namespace {

constexpr double degree = M_PI / 180, g = 9.80665;

/// A section of a part of the plugin.
struct Sheet {
  Part part;
  const PartSection* section;
  std::size_t checked = 0;

  Sheet(const char* name, const char* reading)
      : part(make_part(PartFile::read(std::string(PARTS "/") + name + ".yaml"), error_parameters)),
        section(part.section_of(reading)) {}
  /// Checks that a value agrees with the data sheet to the digits of the file.
  void expect(const char* name, const std::vector<double>& expected) {
    const auto found = section->values.find(name);
    ASSERT_NE(found, section->values.end()) << name;
    ASSERT_EQ(found->second.numbers.size(), expected.size()) << name;
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(found->second.numbers[i], expected[i], 1e-4 * expected[i]) << name;
    ++checked;
  }
  /// Checks that the file has no other values.
  ~Sheet() { EXPECT_EQ(checked, section->values.size()) << part.file << ", " << section->name; }
};

TEST(Part, MPU6050HasTheValuesOfItsDataSheet) {
  Sheet gyro("mpu6050", "angular_velocity");
  gyro.expect("bandwidth", {256});
  gyro.expect("scale_tolerance", {0.03});
  gyro.expect("cross_axis_tolerance", {0.02});
  gyro.expect("g_sensitivity", {0.1 * degree / g});
  gyro.expect("turn_on_bias_tolerance", {20 * degree});
  gyro.expect("noise_density", {0.005 * degree});
  gyro.expect("full_scale", {250 * degree});
  gyro.expect("bits", {16});
  const double lsb = std::ldexp(250, 1 - 16);  // deg/s
  EXPECT_NEAR(1 / lsb, 131, 0.1);
  EXPECT_NEAR(0.005 * std::sqrt(100), 0.05, 1e-12) << "deg/s, total noise of the sheet at 100 Hz";

  Sheet accelerometer("mpu6050", "linear_acceleration");
  accelerometer.expect("bandwidth", {260});
  accelerometer.expect("scale_tolerance", {0.03});
  accelerometer.expect("cross_axis_tolerance", {0.02});
  accelerometer.expect("turn_on_bias_tolerance", {0.05 * g, 0.05 * g, 0.08 * g});
  accelerometer.expect("noise_density", {400e-6 * g});
  accelerometer.expect("full_scale", {2 * g});
  accelerometer.expect("bits", {16});
  EXPECT_EQ(1 / std::ldexp(2, 1 - 16), 16384) << "LSB/g of the sheet";
}

TEST(Part, ADIS16448HasTheValuesOfItsDataSheet) {
  Sheet gyro("adis16448", "angular_velocity"), accelerometer("adis16448", "linear_acceleration");
  gyro.expect("turn_on_bias_tolerance", {3 * 0.5 * degree});
  gyro.expect("bias_instability", {14.5 * degree / 3600});
  gyro.expect("noise_density", {0.0135 * degree});
  gyro.expect("resolution", {0.04 * degree});
  accelerometer.expect("turn_on_bias_tolerance", {3 * 0.020 * g});
  accelerometer.expect("noise_density", {0.23e-3 * g});
  accelerometer.expect("resolution", {g / 1200});
}

TEST(Part, NeoM8IsHalfTheTimeWithinTheCircleOfItsDataSheet) {
  const double median = std::sqrt(2 * std::log(2));  // median length of two normal numbers
  Sheet position("neo_m8", "gps.position"), velocity("neo_m8", "gps.velocity");
  position.expect("gauss_markov_sigma", {2.5 / median, 2.5 / median, 2 * 2.5 / median});
  position.expect("gauss_markov_time", {60});
  position.expect("delay", {0.12});
  velocity.expect("sigma", {0.05 / median, 0.05 / median, 2 * 0.05 / median});
  velocity.expect("delay", {0.12});
}

TEST(Part, MTi1HasTheValuesOfItsDataSheet) {
  Sheet gyro("mti1", "angular_velocity");
  gyro.expect("bandwidth", {255});
  gyro.expect("bias_instability", {10 * degree / 3600});
  gyro.expect("noise_density", {0.007 * degree});
  gyro.expect("full_scale", {2000 * degree});
  Sheet accelerometer("mti1", "linear_acceleration");
  accelerometer.expect("bandwidth", {324, 324, 262});
  accelerometer.expect("bias_instability", {0.03e-3 * g});
  accelerometer.expect("noise_density", {120e-6 * g});
  accelerometer.expect("full_scale", {16 * g});
}

TEST(Part, AS5045Has4096StepsATurn) {
  Sheet encoder("as5045", "encoder.position");
  encoder.expect("resolution", {2 * M_PI / 4096});
  EXPECT_EQ(encoder.section->values.at("resolution").numbers[0], 2 * M_PI / 4096) << "to the bit";
}

TEST(Part, NamesTheSourceOfEveryValue) {
  int values = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PARTS)) {
    std::ifstream file(entry.path());
    bool has_source = false;
    for (std::string line; std::getline(file, line);) {
      has_source = has_source || line.rfind("# Source: ", 0) == 0;
      if (line.rfind("  ", 0) != 0 || line.find("reading:") != std::string::npos) continue;
      EXPECT_NE(line.find(" # "), std::string::npos) << entry.path() << ": " << line;
      ++values;
    }
    EXPECT_TRUE(has_source) << entry.path();
  }
  EXPECT_GE(values, 36);
}

// --- mistakes

std::string complaint(const std::string& text) {
  return test::complaint_of<Error>([&] { make_part(PartFile::parse(text, "my.yaml"), error_parameters); });
}

TEST(Part, IsReadInAllItsForms) {
  const Part part = make_part(PartFile::parse("# a device\r\n\r\ngyro:   # of it\r\n    reading: angular_velocity\r\n"
                                              "    bias: [ 1, -2.5e-3 ,3 ]  # three\r\n    bits: 12\r\n"
                                              "    full_scale: 10\r\n    dropout_reads: hold",
                                              "my.yaml"),
                              error_parameters);
  ASSERT_EQ(part.sections.size(), 1U);
  const PartSection& gyro = part.sections[0];
  EXPECT_EQ(gyro.name, "gyro");
  EXPECT_EQ(gyro.reading, "angular_velocity");
  EXPECT_EQ(gyro.values.at("bias").numbers, (std::vector<double>{1, -2.5e-3, 3}));
  EXPECT_EQ(gyro.values.at("bits").numbers, (std::vector<double>{12}));
  EXPECT_EQ(gyro.values.at("dropout_reads").word, "hold");
  EXPECT_EQ(gyro.values.at("bias").place, "my.yaml:5:11: ");
}

TEST(Part, TellsWhereAMistakeIs) {
  const std::string gyro = "gyro:\n  reading: angular_velocity\n";
  EXPECT_SAYS(complaint(gyro + "  noise_densty: 1\n"),
              "my.yaml:3:3: there is no parameter `noise_densty` (did you mean `noise_density`?)");
  EXPECT_EQ(complaint(gyro + "  noise_density: 1,5\n"), "my.yaml:3:18: `noise_density` is `1,5`, which is no number");
  EXPECT_EQ(complaint(gyro + "  bias: [1, x]\n"), "my.yaml:3:9: `bias` is `x`, which is no number");
  EXPECT_EQ(complaint(gyro + "  noise_density: -1\n"), "my.yaml:3:18: `noise_density` must be numbers from 0 to 1e+09");
  EXPECT_EQ(complaint(gyro + "  noise_density: nan\n"), "my.yaml:3:18: `noise_density` is `nan`, which is no number");
  EXPECT_EQ(complaint(gyro + "  bits: 1.5\n"), "my.yaml:3:9: `bits` must be a whole number from 0 to 48");
  EXPECT_EQ(complaint(gyro + "  delay: [1, 2]\n"), "my.yaml:3:10: `delay` must be a number from 0 to 1e+06");
  EXPECT_EQ(complaint(gyro + "  dropout_reads: last\n"),
            "my.yaml:3:18: `dropout_reads` must be one of `value`, `hold`");
  EXPECT_SAYS(complaint(gyro + "  bias: 1\n  bias: 2\n"), "my.yaml:4:");
  EXPECT_SAYS(complaint(gyro + "  bias:\n"), "my.yaml:3:");
  EXPECT_EQ(complaint("gyro:\n  bias: 1\n"),
            "my.yaml:2:3: section `gyro` has no `reading`: the property whose errors it "
            "has, such as `reading: angular_velocity`");
  EXPECT_EQ(complaint("bias: 1\n"), "my.yaml:1:1: `bias` stands in no section, such as `gyro:`");
  EXPECT_SAYS(complaint("# nothing\n"), "my.yaml:1:1: there is no section");
  EXPECT_EQ(complaint(gyro + "more:\n  reading: angular_velocity\n"),
            "my.yaml:4:12: sections `gyro` and `more` are both of `angular_velocity`");
}

}  // namespace
}  // namespace muro
