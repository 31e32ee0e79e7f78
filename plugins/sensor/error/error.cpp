// SPDX-License-Identifier: MIT
// Computes the reading of a device from the true reading of a sensor; see README.md.
#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "error_chain.hpp"
#include "image_errors.hpp"
#include "measured_place.hpp"
#include "muro/base/number_text.hpp"
#include "muro/plugin.hpp"
#include "neighbour_errors.hpp"
#include "parameters.hpp"
#include "plugins/common/text/counted.hpp"
#include "plugins/common/text/quote.hpp"
#include "published.hpp"
#include "readings.hpp"
#include "settings.hpp"

namespace muro {
std::span<const ReadyPart> ready_parts();  // generated: the files parts/*.yaml
}

namespace {

using namespace muro;

constexpr auto parameters = [] {
  std::array<Parameter, 2 + std::size(error_parameters)> all{
      text("of", "ranges", "the property of the sensor's object to work on; not given: all that the part knows"),
      text("part", "", "a device by its data sheet: adis16448, as5045, mpu6050, mti1, neo_m8, or the path of a file")};
  for (std::size_t i = 0; i < std::size(error_parameters); ++i) all[2 + i] = error_parameters[i];
  return all;
}();
constexpr PropertyUse reads[] = {{"ranges", "or the property that `of` names"},
                                 {"laser.incidence", "pointing above 0: between each ray and the surface's normal"},
                                 {"angular_velocity", "named by `of` or by a part"},
                                 {"linear_acceleration", "the same; and for a g_sensitivity: the specific force"},
                                 {"encoder.position", "named by `of` or by a part"},
                                 {"gps.position", "named by `of` or by a part"},
                                 {"gps.velocity", "named by `of` or by a part"},
                                 {"neighbours", "named by `of`"},
                                 {"camera.depth", "named by `of`"},
                                 {"gps.reference", "for the place of a gps.position"}};
constexpr PropertyUse writes[] = {{"ranges.measured", "or `of`.measured"},
                                  {"latitude.measured", "that of gps.position.measured"},
                                  {"longitude.measured", "that of gps.position.measured"},
                                  {"altitude.measured", "that of gps.position.measured"}};
constexpr Description description{
    .id = "sensor.error",
    .kind = Kind::sensor_error,
    .version = "2.1.0",
    .summary =
        "What a device makes of a true reading: bandwidth, scale, bias and its drift, noise, converter, delay, "
        "dropouts",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

class SensorError final : public Algorithm {
 public:
  void connect(Connector& c) override {
    for (const RobotView* robot : c.robots()) robot_keys_.push_back(robot->key);
    const Parameters& p = c.parameters();
    if (p.given("part")) {
      const std::string_view name = p.text("part");
      part_ = make_part(find_part(name, std::string(c.resolve_path(name)), ready_parts()), error_parameters);
    }
    for (std::uint32_t i = 0; i < c.items().size(); ++i) {
      first_.push_back(std::uint32_t(channels_.size()));
      const ObjectId object = c.items()[i].object;
      if (part_ && !p.given("of")) {
        for (const FoundProperty& found : readings_of_part(c, object, *part_)) add(c, i, found);
      } else {
        add(c, i, find_reading(c, object, p.text("of")));
      }
    }
    first_.push_back(std::uint32_t(channels_.size()));
  }

  void step(const Step& step, Range range) override {
    for (std::uint32_t k = first_[range.begin]; k < first_[range.end]; ++k) {
      const Channel& c = channels_[k];
      const ErrorChain::Sample sample{.seed = step.seed,
                                      .index = step.index,
                                      .incidence = c.incidence ? *c.incidence : std::span<const double>(),
                                      .specific_force = c.specific_force.get()};
      if (c.image)
        c.image.apply(c.chain, c.state, sample);
      else if (c.neighbours)
        c.neighbours.apply(c.chain, c.state, sample, robot_keys_);
      else if (c.truths)
        c.chain.apply(*c.truths, *c.measured, c.state, sample);
      else
        c.chain.apply({c.single_truth, c.numbers}, {c.single_measured, c.numbers}, c.state, sample);
      if (c.place) c.place.write({c.single_measured[0], c.single_measured[1], c.single_measured[2]});
    }
  }

 private:
  /// One reading of one item.
  struct Channel {
    ErrorChain chain;
    std::span<double> state{};
    ArrayIn<double> truths{};  ///< truths and measured: only for an array
    ArrayOut<double> measured{};
    const double* single_truth = nullptr;  ///< single_truth and single_measured: for all others, with their components
    double* single_measured = nullptr;
    std::size_t numbers = 1;
    NeighbourErrors neighbours{};
    ImageErrors image{};
    MeasuredPlace place{};
    ArrayIn<double> incidence{};
    In<Vec3> specific_force{};
  };

  void add(Connector& c, std::uint32_t item, const FoundProperty& found) {
    const ObjectId object = found.object;
    const ReadingShape shape = shape_of(found);
    const PartSection* section = part_ ? part_->section_of(shape.name) : nullptr;
    if (part_ && !section)
      throw Error("part " + part_->file + " has no errors of " + quote(shape.name) + "; it has those of " +
                  readings_of(*part_));
    const GivenErrors given(c.parameters(), section);
    ErrorSettings settings = settings_of(given, shape);
    set_limits(c, object, given, shape, settings);
    const double period = c.rate() > 0 ? 1 / c.rate() : 0;
    check_delay(given, settings.delay, shape, period);
    // sensors and readings of one robot have different random numbers
    const std::uint64_t key = fnv1a(shape.name, fnv1a(c.object_name(object), c.random_key(item)));
    const auto form = shape.has_orientation() ? ErrorChain::Form::with_orientation : ErrorChain::Form::numbers;
    Channel channel{.chain = ErrorChain(settings, shape.components, period, key, form)};
    channel.numbers = found.key->type->scalars();
    if (const std::size_t size = channel.chain.state_size(); size > 0) {
      void* block = c.state_block(object, std::string(shape.name) + ".error", std::uint32_t(size * sizeof(double)));
      channel.state = {static_cast<double*>(block), size};
    }
    if (settings.noise.pointing > 0)
      channel.incidence = ArrayIn<double>(c.read_any(find_incidence(c, object, found.count)));
    if (channel.chain.feels_force()) channel.specific_force = find_force(c, object, given);
    bind(c, object, found, settings, period, channel);
    channels_.push_back(std::move(channel));
  }

  void bind(Connector& c, ObjectId object, const FoundProperty& found, const ErrorSettings& settings, double period,
            Channel& channel) {
    const KeyInfo& of = *found.key;
    if (found.multiplicity == Multiplicity::list) {
      channel.neighbours = {ListIn<neighbours::Neighbour>(c.read_any(found)),
                            c.variable_list(object, published_neighbours_.measured(of))};
      return;
    }
    if (found.multiplicity == Multiplicity::array && *of.type == value_type<float>) {
      channel.image = {ArrayIn<float>(c.read_any(found)),
                       c.variable_array(object, published_image_.measured(of), found.count)};
      return;
    }
    if (found.multiplicity == Multiplicity::array) {
      auto& published = std::get<Published<double>>(published_);
      channel.truths = ArrayIn<double>(c.read_any(found));
      const bool is_scan = of.name == keys::ranges.name;
      channel.measured =
          c.variable_array(object, is_scan ? keys::measured_ranges : published.measured(of), found.count);
      if (!is_scan) published.set_constants(c, object, of, settings, period);
      return;
    }
    const auto bind_value = [&]<class T, class E>(Published<T, E>& published) {
      if (!(*of.type == value_type<T>)) return;
      channel.single_truth = static_cast<const double*>(c.read_any(found));
      channel.single_measured =
          static_cast<double*>(static_cast<void*>(c.variable(object, published.measured(of), zero<T>()).get()));
      published.set_constants(c, object, of, settings, period);
    };
    std::apply([&](auto&... each) { (bind_value(each), ...); }, published_);
    const auto reference =
        of.name == keys::gps_position.name ? c.constant(object, geodetic::key_reference) : std::nullopt;
    if (reference) channel.place = {c, object, std::get<Published<double>>(published_), *reference};
  }

  template <class T>
  static T zero() {
    if constexpr (std::is_same_v<T, Vec3>)
      return Vec3::Zero();
    else if constexpr (std::is_same_v<T, Quat>)
      return Quat::Identity();
    else
      return T{};
  }

  static std::string readings_of(const Part& part) {
    std::vector<std::string> names;
    for (const PartSection& s : part.sections) names.push_back(s.reading);
    return quoted_list(names);
  }

  static FoundProperty find_incidence(Connector& c, ObjectId object, std::uint32_t count) {
    for (const FoundProperty& p : c.properties(object))
      if (p.key->name == keys::laser_incidence.name && p.count == count) return p;
    throw Error("pointing needs the angle of incidence of the rays: give the laser `incidence: true`");
  }

  /// Returns none, with a log message, if a part has a g-sensitivity but the object has no specific force.
  static In<Vec3> find_force(Connector& c, ObjectId object, const GivenErrors& given) {
    constexpr std::string_view name = "linear_acceleration";
    if (const auto found = find_value<Vec3>(c, object, name)) return In<Vec3>(c.read_any(*found));
    const std::string missing = quote(c.object_name(object)) + " has no `linear_acceleration` for the g-sensitivity";
    if (given.in_scenario("g_sensitivity")) throw Error(missing + "; take a sensor.imu, or remove g_sensitivity");
    c.host().log(LogLevel::info, missing + " of the part, which is left out");
    return {};
  }

  static void check_delay(const GivenErrors& given, double delay, const ReadingShape& shape, double period) {
    constexpr double most = 1e7;
    if (period > 0 && DelayLine::samples(delay, period) * double(shape.components) > most)
      given.fail("delay", "a delay of " + number_text(delay) +
                              " s at this rate keeps more than 10 million numbers of " + quote(shape.name) +
                              "; give it a shorter one");
  }

  static void set_limits(const Connector& c, ObjectId object, const GivenErrors& given, const ReadingShape& shape,
                         ErrorSettings& s) {
    Quantiser& q = s.quantiser;
    if (shape.name == keys::ranges.name) {
      q.minimum = c.constant(object, keys::laser_min_range).value_or(q.minimum);
      q.maximum = s.no_echo_from = c.constant(object, keys::laser_max_range).value_or(q.maximum);
    }
    if (given.given("minimum")) q.minimum = given.real("minimum");
    if (given.given("maximum")) q.maximum = given.real("maximum");
    if (q.minimum > q.maximum)
      given.fail("minimum",
                 "minimum (" + number_text(q.minimum) + ") is greater than maximum (" + number_text(q.maximum) + ")");
  }

  std::optional<Part> part_;
  std::vector<std::uint32_t> first_;  ///< first channel of each item, followed by the number of all channels
  std::vector<Channel> channels_;
  std::vector<std::uint64_t> robot_keys_;  ///< keys of the names of all robots, by number
  std::tuple<Published<double>, Published<Vec3>, Published<Twist>, Published<Wrench>, Published<Quat, Vec3>,
             Published<Pose, Twist>>
      published_;
  Published<neighbours::Neighbour> published_neighbours_;
  Published<float> published_image_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<SensorError>(description)};

}  // namespace

MURO_PLUGIN(.name = "sensor_error", .version = description.version, .licence = "MIT",
            .summary = "From the true reading of a sensor to the device's", .algorithms = algorithms)
