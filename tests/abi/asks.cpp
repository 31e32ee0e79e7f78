// SPDX-License-Identifier: MIT
// Sensors that ask their host for extensions: for one that the host has, and for others of the same name.
#include "muro/ext/inspection.hpp"
#include "muro/plugin.hpp"

namespace {

using namespace muro;

/// LiveProperty with one more member: the struct of an SDK whose author forgot to change the version.
struct LongerProperty : LiveProperty {
  double unit_factor = 1;
};
/// Inspection with one more function.
class LongerInspection : public Inspection {
 public:
  virtual double time() const noexcept = 0;

 protected:
  ~LongerInspection() = default;
};

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Winvalid-offsetof"
/// Returns what Inspection::id() returns in an SDK with this interface and this struct.
template <class Interface, class Property>
ExtensionId inspection_with() {
  static constexpr abi::Place structs[] = {MURO_SIZE(Property),
                                           MURO_PLACE(Property, key),
                                           MURO_PLACE(Property, multiplicity),
                                           MURO_PLACE(Property, count),
                                           MURO_PLACE(Property, data),
                                           MURO_PLACE(Property, is_constant),
                                           MURO_PLACE(Property, is_variable),
                                           MURO_PLACE(Property, written_by),
                                           MURO_SIZE(LiveCost),
                                           MURO_PLACE(LiveCost, name),
                                           MURO_PLACE(LiveCost, runs),
                                           MURO_PLACE(LiveCost, seconds),
                                           MURO_PLACE(LiveCost, runs_alone)};
  return {"muro.Inspection", 1,
          abi::extension_layout<Interface>(structs, &Interface::properties, &Interface::costs, &Interface::object_count,
                                           &Interface::object_name, &Interface::text, &Interface::stop,
                                           &Interface::is_stopping)};
}
#pragma GCC diagnostic pop

ExtensionId of_version_2() {
  ExtensionId id = Inspection::id();
  id.version = 2;
  return id;
}
ExtensionId unheard_of() { return {"example.Weather", 1, 0}; }

template <ExtensionId (*Id)()>
class Asks final : public Algorithm {
 public:
  void connect(Connector& c) override {
    c.host().log(LogLevel::info, c.host().find_extension(Id()) ? "granted" : "refused");
  }
  void step(const Step&, Range) override {}
};

template <char const* Id>
constexpr Description description{.id = Id, .kind = Kind::sensor, .version = "1.0.0", .summary = "Asks its host"};

constexpr char same[] = "sensor.asks_the_same";
constexpr char data[] = "sensor.asks_more_data";
constexpr char functions[] = "sensor.asks_more_functions";
constexpr char version[] = "sensor.asks_version_2";
constexpr char unheard[] = "sensor.asks_unheard_of";
constexpr abi::AlgorithmEntry algorithms[] = {
    algorithm<Asks<inspection_with<Inspection, LiveProperty>>>(description<same>),
    algorithm<Asks<inspection_with<Inspection, LongerProperty>>>(description<data>),
    algorithm<Asks<inspection_with<LongerInspection, LiveProperty>>>(description<functions>),
    algorithm<Asks<of_version_2>>(description<version>), algorithm<Asks<unheard_of>>(description<unheard>)};

}  // namespace

MURO_PLUGIN(.name = "asks", .version = "1.0.0", .licence = "MIT", .summary = "Asks for extensions",
            .algorithms = algorithms)
