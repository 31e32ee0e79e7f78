// SPDX-License-Identifier: MIT
// From the true reading of a sensor to the device's; see README.md.
#include <memory>
#include <string>
#include <vector>

#include "model.hpp"
#include "muro/plugin.hpp"
#include "plugins/common/text/quote.hpp"

namespace {

using namespace muro;

constexpr Parameter parameters[] = {
    text("of", "ranges", "the property of the sensor's object to work on: a real number or an array of them"),
    real("sigma", "as read", 0, "standard deviation of the noise").between(0, 1e9),
    real("sigma_relative", "1", 0, "standard deviation of further noise, in proportion to the reading").between(0, 1e3),
    real("pointing", "rad", 0,
         "standard deviation of a ray's direction: adds noise with the angle of incidence; needs laser.incidence")
        .between(0, 1),
    real("correlation", "1", 0, "of the noise of neighbours in an array").between(-1, 1),
    real("bias", "as read", 0, "added to every reading").between(-1e9, 1e9),
    real("resolution", "as read", 0, "readings are multiples of this; 0: any value").between(0, 1e9),
    real("minimum", "as read", 0, "smallest reading; not given: laser.min_range, otherwise none"),
    real("maximum", "as read", 0, "largest reading; not given: laser.max_range, otherwise none"),
    real("dropout", "1", 0, "probability that a reading is lost").between(0, 1),
    real("dropout_value", "as read", 0, "what a lost reading reads"),
};
constexpr PropertyUse reads[] = {{"ranges", "or the property that `of` names"},
                                 {"laser.incidence", "pointing above 0: between each ray and the surface's normal"}};
constexpr PropertyUse writes[] = {{"ranges.measured", "or `of`.measured"}};
constexpr Description description{
    .id = "sensor.error",
    .kind = Kind::sensor_error,
    .version = "1.0.0",
    .summary = "Noise (also correlated), bias, rounding, limits and dropouts of a device",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

class SensorError final : public Algorithm {
 public:
  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    const std::string_view of = p.text("of");
    for (std::uint32_t i = 0; i < c.items().size(); ++i) {
      const ObjectId object = c.items()[i].object;
      const FoundProperty found = find(c, object, of);
      Sensor s;
      // of one robot, sensors and readings each have numbers of their own
      s.random_key = fnv1a(of, fnv1a(c.object_name(object), c.random_key(i)));
      s.model = model_of(p, c, object);
      if (found.multiplicity == Multiplicity::array) {
        s.truth = ArrayIn<double>(c.read_any(found));
        s.measured = c.variable_array(object, output_key(*found.key), found.count);
        if (s.model.pointing > 0) s.incidence = ArrayIn<double>(c.read_any(find_incidence(c, object, found.count)));
      } else {
        if (p.given("correlation"))
          throw Error("correlation is between neighbours in an array, but " + quote(of) +
                      " is a single number; remove it");
        if (p.given("pointing"))
          throw Error("pointing is of the rays of a laser, but " + quote(of) + " is a single number; remove it");
        s.single_truth = In<double>(c.read_any(found));
        s.single_measured = c.variable(object, output_key(*found.key), 0.0);
      }
      sensors_.push_back(s);
    }
  }

  void step(const Step& step, Range range) override {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const Sensor& s = sensors_[i];
      const Random random(step.seed, s.random_key, step.index);
      if (s.truth)
        s.model.apply(*s.truth, *s.measured, random, s.incidence ? *s.incidence : std::span<const double>());
      else
        s.model.apply({s.single_truth.get(), 1}, {s.single_measured.get(), 1}, random);
    }
  }

 private:
  struct Sensor {
    std::uint64_t random_key = 0;
    ErrorModel model;
    ArrayIn<double> truth;  ///< and measured: when the reading is an array
    ArrayIn<double> incidence;
    ArrayOut<double> measured;
    In<double> single_truth;
    Out<double> single_measured;
  };

  /// A key whose texts it owns.
  struct MeasuredKey {
    std::string name, unit;
    Key<double> key;
    explicit MeasuredKey(const KeyInfo& of)
        : name(std::string(of.name) + ".measured"), unit(of.unit), key(name, unit, "as the device reports it") {}
    MeasuredKey(const MeasuredKey&) = delete;
    MeasuredKey& operator=(const MeasuredKey&) = delete;
  };

  /// The property to work on; throws when it is missing or not made of real numbers.
  static FoundProperty find(Connector& c, ObjectId object, std::string_view name) {
    std::string others;
    for (const FoundProperty& p : c.properties(object)) {
      const bool usable = p.multiplicity != Multiplicity::list && *p.key->type == value_type<double> && p.count > 0;
      if (p.key->name == name && usable) return p;
      if (p.key->name == name)
        throw Error(quote(name) + " of " + quote(c.object_name(object)) + " is not made of real numbers (f64) but of " +
                    std::string(p.key->type->name) + (p.multiplicity == Multiplicity::list ? ", in a list" : "") +
                    "; sensor.error works on single numbers and arrays of f64");
      if (usable) others += (others.empty() ? "" : ", ") + std::string(p.key->name);
    }
    throw Error(quote(c.object_name(object)) + " has no property " + quote(name) +
                (others.empty() ? "; add the sensor that writes it" : "; it has " + others));
  }

  static FoundProperty find_incidence(Connector& c, ObjectId object, std::uint32_t count) {
    for (const FoundProperty& p : c.properties(object))
      if (p.key->name == keys::laser_incidence.name && p.count == count) return p;
    throw Error("pointing needs the angle of incidence of the rays: give the laser `incidence: true`");
  }

  static ErrorModel model_of(const Parameters& p, const Connector& c, ObjectId object) {
    ErrorModel m{.sigma = p.real("sigma"),
                 .sigma_relative = p.real("sigma_relative"),
                 .pointing = p.real("pointing"),
                 .correlation = p.real("correlation"),
                 .bias = p.real("bias"),
                 .resolution = p.real("resolution"),
                 .dropout = p.real("dropout"),
                 .dropout_value = p.real("dropout_value")};
    if (p.text("of") == keys::ranges.name) {
      m.minimum = c.constant(object, keys::laser_min_range).value_or(m.minimum);
      m.maximum = m.no_echo_from = c.constant(object, keys::laser_max_range).value_or(m.maximum);
    }
    if (p.given("minimum")) m.minimum = p.real("minimum");
    if (p.given("maximum")) m.maximum = p.real("maximum");
    if (m.minimum > m.maximum)
      throw Error("minimum (" + std::to_string(m.minimum) + ") is greater than maximum (" + std::to_string(m.maximum) +
                  ")");
    return m;
  }

  const Key<double>& output_key(const KeyInfo& of) {
    if (of.name == keys::ranges.name) return keys::measured_ranges;
    if (!measured_key_) measured_key_ = std::make_unique<MeasuredKey>(of);
    return measured_key_->key;
  }

  std::vector<Sensor> sensors_;
  std::unique_ptr<MeasuredKey> measured_key_;  ///< the property keeps pointing to its texts
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<SensorError>(description)};

}  // namespace

MURO_PLUGIN(.name = "sensor_error", .version = description.version, .licence = "MIT",
            .summary = "From the true reading of a sensor to the device's", .algorithms = algorithms)
