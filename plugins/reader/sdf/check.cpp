// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include "checks.hpp"
#include "muro/toolkit/did_you_mean.hpp"
#include "plugins/common/model_file/numbers.hpp"

namespace muro::sdf {

namespace {

using Form = Known::Form;

std::string lower_case(std::string text) {
  for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Whether a left-out element says what is the case anyway.
bool is_harmless(const Element& e, const Known& known) {
  if (known.harmless.empty()) return false;
  std::string says = lower_case(text_of(e));
  if (known.harmless == "true" && says == "1") says = "true";
  if (known.harmless == "false" && says == "0") says = "false";
  if (says == known.harmless) return true;
  std::string trouble;
  const auto a = model_file::parse_numbers(says, trouble), b = model_file::parse_numbers(known.harmless, trouble);
  return trouble.empty() && !a.empty() && a == b;
}

std::vector<std::string> names_within(std::string_view inside) {
  std::vector<std::string> names;
  for (const Known& k : all_known())
    if (k.inside == inside && k.form != Form::left_out) names.emplace_back(k.name);
  return names;
}

}  // namespace

std::string text_of(const Element& e) {
  const char* text = e.GetText();
  std::string_view whole = text ? text : "";
  const std::size_t begin = whole.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return {};
  return std::string(whole.substr(begin, whole.find_last_not_of(" \t\r\n") + 1 - begin));
}

std::string child_text(Element& e, const char* name) {
  const Element* child = e.FirstChildElement(name);
  return child ? text_of(*child) : std::string();
}

void check(Source& source, Sources& sources, Problems& problems) { Check(source, sources, problems).run(); }

void Check::run() {
  section(*source_.document->root(), "sdf");
  tell_left_out();
}

void Check::section(Element& e, std::string_view as) {
  attributes(e, as);
  prepare(e, as);
  std::set<std::string> seen;
  for (Element* child : model_file::children(e)) {
    const std::string name = child->Name();
    const Known* known = find_known(as, name);
    if (!known || known->form == Form::left_out) {
      leave_out(*child, known, as);
      e.DeleteChild(child);
    } else if (!known->many && !seen.insert(name).second) {
      problems_.warning(at(*child), say("a second <", name, "> in one <", e.Name(), "> is left out"));
      e.DeleteChild(child);
    } else if (known->form == Form::section) {
      section(*child, known->section);
    } else {
      leaf(*child, *known);
    }
  }
  // last, for it may remove the element
  if (!complete(e, as) && e.Parent()) e.Parent()->DeleteChild(&e);
}

void Check::attributes(Element& e, std::string_view section) {
  std::vector<std::string> unknown;
  for (const auto* a = e.FirstAttribute(); a; a = a->Next())
    if (!knows_attribute(section, a->Name())) unknown.emplace_back(a->Name());
  for (const std::string& name : unknown) {
    // names with a prefix are for other programs
    if (name.find(':') == std::string::npos && name != "xmlns")
      problems_.warning(at(e), say("<", e.Name(), "> has the attribute ", cited(name), ", which is not read"));
    e.DeleteAttribute(name.c_str());
  }
}

void Check::leaf(Element& e, const Known& known) {
  attributes(e, known.form == Form::pose ? "pose" : known.name);
  for (Element* child : model_file::children(e)) {
    leave_out(*child, nullptr, known.name);
    e.DeleteChild(child);
  }
  switch (known.form) {
    case Form::numbers:
      return numbers(e, std::size_t(known.count), false);
    case Form::limit:
      return numbers(e, 1, true);
    case Form::pose: {
      const bool quaternion = attribute(e, "rotation_format") == "quat_xyzw";
      if (text_of(e).empty()) e.SetText(quaternion ? "0 0 0 0 0 0 1" : "0 0 0 0 0 0");
      return numbers(e, quaternion ? 7 : 6, false);
    }
    case Form::color: {
      std::string trouble;
      const auto values = model_file::parse_numbers(text_of(e), trouble);
      return numbers(e, values.size() == 3 ? 3 : 4, false);
    }
    case Form::flag: {
      const std::string says = lower_case(text_of(e));
      if (says == "true" || says == "1" || says == "false" || says == "0") return;
      problems_.error(at(e), say("<", e.Name(), ">: ", cited(text_of(e)), " is none of true, false, 1, 0"));
      return;
    }
    default: {
      const std::string text = text_of(e);
      e.DeleteChildren();
      e.SetText(text.c_str());
    }
  }
}

void Check::numbers(Element& e, std::size_t count, bool infinite) {
  const std::string text = text_of(e);
  if (infinite && (lower_case(text) == "inf" || lower_case(text) == "-inf" || lower_case(text) == "+inf")) return;
  std::string trouble;
  const auto values = model_file::parse_numbers(text, trouble);
  if (trouble.empty() && values.size() != count)
    trouble = say("has ", values.size(), values.size() == 1 ? " number" : " numbers", ", and needs ", count,
                  count == 1 ? "" : " separated by blanks");
  if (!trouble.empty()) {
    problems_.error(at(e), say("<", e.Name(), ">: ", cited(text), " ", trouble));
    return;
  }
  std::string rewritten;
  for (const double v : values) rewritten += (rewritten.empty() ? "" : " ") + model_file::shortest(v);
  e.DeleteChildren();
  e.SetText(rewritten.c_str());
}

void Check::leave_out(Element& e, const Known* known, std::string_view inside) {
  if (known && is_harmless(e, *known)) return;
  const std::string name = e.Name();
  const bool foreign = name.find(':') != std::string::npos;
  const auto* parent = e.Parent()->ToElement();
  LeftOut left{known     ? known->severity
               : foreign ? Severity::note
                         : Severity::warning,
               say("<", name, "> in <", parent ? parent->Name() : "", ">"),
               std::string(known ? known->why : "SDFormat has no such element there"),
               {}};
  if (!known && foreign) left.why = "it is meant for another program";
  if (!known && !foreign) left.why += did_you_mean(name, names_within(inside));
  auto same = std::find_if(left_out_.begin(), left_out_.end(),
                           [&](const LeftOut& l) { return l.what == left.what && l.why == left.why; });
  if (same == left_out_.end()) same = left_out_.insert(left_out_.end(), std::move(left));
  same->places.push_back(at(e));
}

void Check::tell_left_out() {
  constexpr std::size_t most = 8;
  for (const LeftOut& l : left_out_) {
    std::string also;
    for (std::size_t i = 1; i < std::min(l.places.size(), most); ++i)
      also += (i > 1 ? ", " : "") + say(l.places[i].place.line);
    if (l.places.size() > most) also += say(" and ", l.places.size() - most, " more");
    if (!also.empty()) also = say(l.places.size() > 2 ? " (also in lines " : " (also in line ", also, ")");
    problems_.tell(l.severity, l.places.front(), say(l.what, " is left out", also, ": ", l.why));
  }
}

}  // namespace muro::sdf
