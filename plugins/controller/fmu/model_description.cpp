// SPDX-License-Identifier: MIT
#include "model_description.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "muro/algorithm.hpp"
#include "plugins/common/model_file/document.hpp"
#include "plugins/common/model_file/numbers.hpp"
#include "plugins/common/model_file/text_file.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::fmu {

using model_file::Element;

namespace {

struct TypeNames {
  Type type;
  std::string_view in_2, in_3;  ///< empty: the version does not have it
};
constexpr std::array<TypeNames, type_count> type_names{{{Type::float64, "Real", "Float64"},
                                                        {Type::float32, "", "Float32"},
                                                        {Type::int64, "", "Int64"},
                                                        {Type::uint64, "", "UInt64"},
                                                        {Type::int32, "Integer", "Int32"},
                                                        {Type::uint32, "", "UInt32"},
                                                        {Type::int16, "", "Int16"},
                                                        {Type::uint16, "", "UInt16"},
                                                        {Type::int8, "", "Int8"},
                                                        {Type::uint8, "", "UInt8"},
                                                        {Type::boolean, "Boolean", "Boolean"},
                                                        {Type::enumeration, "Enumeration", "Enumeration"},
                                                        {Type::string, "String", "String"},
                                                        {Type::binary, "", "Binary"}}};

constexpr std::pair<std::string_view, Causality> causality_names[] = {
    {"parameter", Causality::parameter},
    {"calculatedParameter", Causality::calculated_parameter},
    {"input", Causality::input},
    {"output", Causality::output},
    {"local", Causality::local},
    {"independent", Causality::independent},
    {"structuralParameter", Causality::structural_parameter}};

/// Returns the product of the lengths; nothing when it is above largest_array.
std::optional<std::uint64_t> size_of_array(const std::vector<Dimension>& dimensions) {
  std::uint64_t size = 1;
  for (const Dimension& d : dimensions) {
    if (d.length > largest_array || size * d.length > largest_array) return std::nullopt;
    size *= d.length;
  }
  return size;
}

bool is_integer(Type type) { return type >= Type::int64 && type <= Type::uint8; }

bool is_c_name(std::string_view text) {
  const auto is_word = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !text.empty() && text.size() < 200 && std::all_of(text.begin(), text.end(), is_word);
}

}  // namespace

std::string_view name_of(Type type, int version) {
  const TypeNames& names = type_names[std::size_t(type)];
  return version == 2 ? names.in_2 : names.in_3;
}

const Variable* ModelDescription::find(std::string_view name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : &variables[found->second];
}

std::string ModelDescription::flag_of_state(std::string_view verb) const {
  return "can" + std::string(verb) + (version == 2 ? "FMUstate" : "FMUState");
}

bool ModelDescription::is_length(std::size_t variable) const {
  const auto is_of_it = [&](const Dimension& d) { return d.parameter == variable; };
  return std::any_of(variables.begin(), variables.end(), [&](const Variable& v) {
    return std::any_of(v.dimensions.begin(), v.dimensions.end(), is_of_it);
  });
}

bool ModelDescription::set_length(std::size_t variable, std::uint64_t length) {
  for (Variable& v : variables) {
    for (Dimension& d : v.dimensions)
      if (d.parameter == variable) d.length = length;
    const auto size = size_of_array(v.dimensions);
    if (!size) return false;
    v.size = *size;
  }
  return true;
}

class DescriptionReader {
 public:
  explicit DescriptionReader(const std::string& path) : path_(path) {}

  ModelDescription read(std::string bytes) {
    if (const auto problems = model_file::decode(bytes, "modelDescription.xml", "fmiModelDescription");
        !problems.error.text.empty())
      fail(problems.error.location, problems.error.text);
    model_file::Location location;
    std::string error;
    if (!document_.parse(bytes, location, error)) fail(location, error);
    if (!document_.root()) fail({}, "there is no element; an FMU's file holds <fmiModelDescription>");
    Element& root = *document_.root();
    if (std::string_view(root.Name()) != "fmiModelDescription")
      fail(root, "the root element is <" + std::string(root.Name()) + ">; that of an FMU is <fmiModelDescription>");
    read_version(root);
    out_.model_name = text(root, "modelName");
    if (const char* version = root.Attribute("version")) out_.model_version = version;
    if (const char* tool = root.Attribute("generationTool")) out_.generation_tool = tool;
    out_.token = text(root, out_.version == 2 ? "guid" : "instantiationToken");
    read_interface(root);
    if (Element* units = child(root, "UnitDefinitions")) read_units(*units);
    if (Element* types = child(root, "TypeDefinitions")) read_types(*types);
    if (Element* experiment = child(root, "DefaultExperiment")) {
      out_.tolerance = number(*experiment, "tolerance", 0);
      out_.preferred_step = number(*experiment, "stepSize", 0);
    }
    Element* variables = child(root, "ModelVariables");
    if (!variables) fail(root, "there is no <ModelVariables>, which lists the variables of the FMU");
    read_variables(*variables);
    return std::move(out_);
  }

 private:
  // --- messages
  [[noreturn]] void fail(const model_file::Location& at, const std::string& what) const {
    std::string place = path_ + ": modelDescription.xml";
    if (at.line > 0) place += ":" + std::to_string(at.line);
    throw Error(place + ": " + what);
  }
  [[noreturn]] void fail(const Element& at, const std::string& what) const { fail(model_file::location_of(at), what); }

  // --- attributes
  static Element* child(Element& parent, const char* name) { return parent.FirstChildElement(name); }
  std::string text(const Element& e, const char* name) const {
    if (const char* value = e.Attribute(name)) return value;
    fail(e, "<" + std::string(e.Name()) + "> has no attribute `" + name + "`, which it needs");
  }
  bool flag(const Element& e, const char* name) const {
    const char* value = e.Attribute(name);
    const std::string_view word = value ? value : "false";
    if (word == "true" || word == "1") return true;
    if (word != "false" && word != "0") fail(e, std::string(name) + " is " + quote(word) + "; it is true or false");
    return false;
  }
  double number(const Element& e, const char* name, double otherwise) const {
    const char* value = e.Attribute(name);
    if (!value) return otherwise;
    std::string error;
    const auto numbers = model_file::parse_numbers(value, 1, error);
    if (!numbers) fail(e, std::string(name) + ": " + quote(value) + " " + error);
    return numbers->front();
  }
  template <class T>
  T whole_number(const Element& e, const char* name) const {
    const std::string value = text(e, name);
    T result = 0;
    const auto [end, code] = std::from_chars(value.data(), value.data() + value.size(), result);
    if (code != std::errc() || end != value.data() + value.size())
      fail(e, std::string(name) + " is " + quote(value) + "; it is a whole number" +
                  (std::is_unsigned_v<T> ? " from 0 on" : ""));
    return result;
  }

  // --- parts
  void read_version(const Element& root) {
    const std::string version = text(root, "fmiVersion");
    if (version == "2.0" || version.starts_with("2.0.")) out_.version = 2;
    if (version.starts_with("3.") && version.find('-') == version.npos) out_.version = 3;
    if (out_.version == 0)
      fail(root,
           "fmiVersion is " + quote(version) + "; 2.0 and 3.0 are offered. Export the model anew for one of them");
  }

  void read_interface(Element& root) {
    Element* cs = child(root, "CoSimulation");
    if (!cs) {
      const char* other = child(root, "ModelExchange")        ? "ModelExchange"
                          : child(root, "ScheduledExecution") ? "ScheduledExecution"
                                                              : nullptr;
      fail(root, other ? "the FMU offers " + std::string(other) +
                             " only; co-simulation is what is run here: export the model for it (<CoSimulation>)"
                       : "there is no <CoSimulation>, which says how the FMU is run");
    }
    const std::string state = out_.version == 2 ? "FMUstate" : "FMUState";
    out_.identifier = text(*cs, "modelIdentifier");
    if (!is_c_name(out_.identifier))
      fail(*cs, "modelIdentifier is " + quote(out_.identifier) + "; it consists of letters, digits and _");
    if (flag(*cs, "needsExecutionTool"))
      fail(*cs, "the FMU has the flag needsExecutionTool: it only talks to the program that made it" +
                    (out_.generation_tool.empty() ? "" : " (" + quote(out_.generation_tool) + ")") +
                    ", which is not started here. Export the model with its code inside");
    out_.once_per_process = flag(*cs, "canBeInstantiatedOnlyOncePerProcess");
    out_.variable_step_size = flag(*cs, "canHandleVariableCommunicationStepSize");
    out_.can_keep_state = flag(*cs, ("canGetAndSet" + state).c_str());
    out_.can_serialize_state = flag(*cs, ("canSerialize" + state).c_str()) && out_.can_keep_state;
    if (out_.version < 3) return;
    out_.might_return_early = flag(*cs, "mightReturnEarlyFromDoStep");
    out_.fixed_internal_step = number(*cs, "fixedInternalStepSize", 0);
    if (out_.fixed_internal_step < 0) fail(*cs, "fixedInternalStepSize is negative");
  }

  void read_units(Element& list) {
    for (Element* e = child(list, "Unit"); e; e = e->NextSiblingElement("Unit")) {
      Unit unit{text(*e, "name"), {}};
      if (Element* base = child(*e, "BaseUnit")) {
        unit.base.emplace();
        for (std::size_t i = 0; i < base_unit_names.size(); ++i)
          if (const std::string name(base_unit_names[i]); base->Attribute(name.c_str()))
            unit.base->exponents[i] = whole_number<int>(*base, name.c_str());
        unit.base->factor = number(*base, "factor", 1);
        unit.base->offset = number(*base, "offset", 0);
        if (unit.base->factor == 0) fail(*base, "unit " + quote(unit.name) + " has the factor 0");
      }
      const std::string name = unit.name;
      if (!out_.units.emplace(name, std::move(unit)).second) fail(*e, "unit " + quote(name) + " is defined twice");
    }
  }

  /// The parts of a variable that come from its type.
  struct DeclaredType {
    std::string unit;
    bool is_relative = false;
    std::shared_ptr<const EnumerationItems> items;
  };
  std::shared_ptr<const EnumerationItems> read_items(const Element& type) const {
    auto items = std::make_shared<EnumerationItems>();
    for (const Element* e = type.FirstChildElement("Item"); e; e = e->NextSiblingElement("Item"))
      items->emplace_back(text(*e, "name"), whole_number<std::int64_t>(*e, "value"));
    return items->empty() ? nullptr : items;
  }
  void read_types(Element& list) {
    for (Element* e = list.FirstChildElement(); e; e = e->NextSiblingElement()) {
      const char* name = e->Attribute("name");
      const Element* holder = out_.version == 2 ? e->FirstChildElement() : e;
      if (!name || !holder) continue;
      DeclaredType type;
      if (const char* unit = holder->Attribute("unit")) type.unit = unit;
      type.is_relative = flag(*holder, "relativeQuantity");
      type.items = read_items(*holder);
      types_[name] = type;
    }
  }

  void read_variables(Element& list) {
    for (Element* e = list.FirstChildElement(); e; e = e->NextSiblingElement()) {
      const Element* typed = e;
      if (out_.version == 2) {
        if (std::string_view(e->Name()) != "ScalarVariable") continue;
        typed = e->FirstChildElement();
        while (typed && std::string_view(typed->Name()) == "Annotations") typed = typed->NextSiblingElement();
        if (!typed) fail(*e, "variable " + quote(text(*e, "name")) + " has no type, such as <Real/>");
      }
      read_variable(*e, *typed);
    }
    resolve_dimensions();
  }

  Type type_of(const Element& typed, const std::string& variable) const {
    const std::string_view name = typed.Name();
    if (name == "Clock")
      fail(typed, "variable " + quote(variable) +
                      " is a clock; FMUs with Clocks need event mode (hasEventMode), which is not offered here");
    for (const TypeNames& t : type_names)
      if ((out_.version == 2 ? t.in_2 : t.in_3) == name && !name.empty()) return t.type;
    fail(typed, "<" + std::string(name) + "> of variable " + quote(variable) + " is no type of FMI " +
                    std::to_string(out_.version));
  }

  void read_variable(const Element& e, const Element& typed) {
    Variable v;
    v.name = text(e, "name");
    v.line = model_file::location_of(e).line;
    v.reference = whole_number<std::uint32_t>(e, "valueReference");
    v.type = type_of(typed, v.name);
    if (e.Attribute("clocks"))
      fail(e, "variable " + quote(v.name) +
                  " belongs to Clocks, which need event mode (hasEventMode); it is not offered here");
    if (const char* word = e.Attribute("causality")) {
      const auto* const found = std::find_if(std::begin(causality_names), std::end(causality_names),
                                             [&](const auto& c) { return c.first == word; });
      if (found == std::end(causality_names) || (found->second == Causality::structural_parameter && out_.version == 2))
        fail(e, "causality of variable " + quote(v.name) + " is " + quote(word) + ", which the standard does not know");
      v.causality = found->second;
    }
    const auto word = [&](const char* name) -> std::string_view { return e.Attribute(name) ? e.Attribute(name) : ""; };
    v.is_tunable = v.causality == Causality::parameter && word("variability") == "tunable";
    const bool is_parameter = v.causality == Causality::parameter || v.causality == Causality::structural_parameter;
    v.is_continuous = (v.type == Type::float64 || v.type == Type::float32) && !is_parameter &&
                      v.causality != Causality::calculated_parameter &&
                      (word("variability").empty() || word("variability") == "continuous");
    v.may_be_set = word("variability") != "constant" && (is_parameter || v.causality == Causality::input ||
                                                         word("initial") == "exact" || word("initial") == "approx");
    if (const char* declared = typed.Attribute("declaredType"))
      if (const auto type = types_.find(declared); type != types_.end()) {
        v.unit = type->second.unit;
        v.is_relative = type->second.is_relative;
        if (v.type == Type::enumeration) v.items = type->second.items;
      }
    if (const char* unit = typed.Attribute("unit")) v.unit = unit;
    if (typed.Attribute("relativeQuantity")) v.is_relative = flag(typed, "relativeQuantity");
    if ((v.causality == Causality::structural_parameter || word("variability") == "constant") && e.Attribute("start") &&
        !e.FirstChildElement("Dimension"))
      lengths_[v.reference] = out_.variables.size();
    const std::string name = v.name;
    if (!out_.by_name_.emplace(name, out_.variables.size()).second)
      fail(e, "variable " + quote(name) + " is there twice; names are unique");
    out_.variables.push_back(std::move(v));
    elements_.push_back(&e);
  }

  void resolve_dimensions() {
    for (std::size_t i = 0; i < out_.variables.size() && out_.version == 3; ++i) {
      Variable& v = out_.variables[i];
      for (const Element* d = elements_[i]->FirstChildElement("Dimension"); d; d = d->NextSiblingElement("Dimension")) {
        v.dimensions.push_back(dimension_of(*d, v));
        const auto size = size_of_array(v.dimensions);
        if (!size)
          fail(*d, "variable " + quote(v.name) + " has more than " + std::to_string(largest_array) +
                       " elements, which is the most that is read");
        v.size = *size;
      }
    }
  }

  Dimension dimension_of(const Element& d, const Variable& of) const {
    if (d.Attribute("start")) return {whole_number<std::uint64_t>(d, "start"), std::nullopt};
    const auto found = lengths_.find(whole_number<std::uint32_t>(d, "valueReference"));
    if (found == lengths_.end())
      fail(d, "a dimension of variable " + quote(of.name) + " refers to no structuralParameter with a start value");
    const Variable& by = out_.variables[found->second];
    if (!is_integer(by.type))
      fail(d, "a dimension of variable " + quote(of.name) + " refers to " + quote(by.name) + ", which is of type " +
                  std::string(name_of(by.type, out_.version)) + "; lengths are of type UInt64");
    return {whole_number<std::uint64_t>(*elements_[found->second], "start"), found->second};
  }

  const std::string& path_;
  model_file::Document document_;
  ModelDescription out_;
  std::map<std::string, DeclaredType, std::less<>> types_;
  std::map<std::uint32_t, std::size_t> lengths_;  ///< variables that dimensions may refer to, by value reference
  std::vector<const Element*> elements_;          ///< XML element of each variable
};

ModelDescription read_model_description(std::string bytes, const std::string& path) {
  return DescriptionReader(path).read(std::move(bytes));
}

}  // namespace muro::fmu
