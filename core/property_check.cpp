// SPDX-License-Identifier: MIT
// The check of a property store before a run: which algorithms write, read and add to each property.
#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/property_store.hpp"

namespace muro {

/// A property that two algorithms write, and the number of others that they both write: one mistake is reported once.
struct PropertyStore::TwoWriters {
  Accessor first, second;
  std::string property;
  std::size_t more = 0;
};

void PropertyStore::add(std::vector<TwoWriters>& all, TwoWriters found) {
  for (TwoWriters& w : all)
    if (w.first == found.first && w.second == found.second) {
      ++w.more;
      return;
    }
  all.push_back(std::move(found));
}

void PropertyStore::check_slot(const Slot& s, const std::function<std::string(std::string_view)>& writers_of,
                               std::vector<TwoWriters>& two_writers, std::vector<std::string>& problems) const {
  const KeyInfo& key = key_of(s);
  const std::string property = where(s.object, key.name);
  const Slot::User* writer = nullptr;
  const Slot::User* reader = nullptr;
  const Slot::User* contributor = nullptr;
  const Slot::User* sum_reader = nullptr;
  for (const Slot::User& u : s.users) {
    if (u.usage.access == Access::write) {
      if (writer && writer->accessor != u.accessor && !alternate(s.object, writer->accessor, u.accessor))
        add(two_writers, {writer->accessor, u.accessor, property});
      writer = writer ? writer : &u;
    }
    if (u.usage == usage::read && !reader) reader = &u;
    if (u.usage == usage::accumulate && !contributor) contributor = &u;
    if (u.usage == usage::read_sum && !sum_reader) sum_reader = &u;
  }
  if (writer && sum_reader)
    problems.push_back(
        fmt::format("{} is written by {}, but {} reads the sum of contributions; the writer must add to it", property,
                    who(writer->accessor), who(sum_reader->accessor)));
  if (writer && contributor)
    problems.push_back(fmt::format("{} is written by {} and added to by {}; all of them must add", property,
                                   who(writer->accessor), who(contributor->accessor)));
  if (reader && !writer && s.kind != Slot::Class::constant && !s.used_as(usage::input)) {
    const std::string writers = writers_of(key.name);
    problems.push_back(fmt::format("{} ({}) is read by {}, but nothing writes it{}{}", property, key.doc,
                                   who(reader->accessor), writers.empty() ? "" : "; add one of: ", writers));
  }
  const bool is_read = reader || s.used_as(usage::input);
  if (key.role == Role::command && writer && writer->usage == usage::write && !is_read)
    problems.push_back(
        fmt::format("{} ({}) is commanded by {}, but nothing that moves `{}` uses this command; choose another motion "
                    "algorithm, or add a drive",
                    property, key.doc, who(writer->accessor), object_name(s.object)));
}

void PropertyStore::check(const std::function<std::string(std::string_view)>& writers_of) const {
  std::vector<std::string> all = problems_;
  std::vector<TwoWriters> two_writers;
  for (const Slot& s : slots_) check_slot(s, writers_of, two_writers, all);
  for (const TwoWriters& w : two_writers)
    all.push_back(fmt::format("{} has two writers: {} and {}; only one algorithm may write a property{}", w.property,
                              who(w.first), who(w.second),
                              w.more == 0 ? "" : fmt::format(" (the same holds for {} more)", w.more)));
  std::vector<std::string> problems;  // each once: a mistake in a template is repeated in all of its robots
  for (std::string& p : all)
    if (std::find(problems.begin(), problems.end(), p) == problems.end()) problems.push_back(std::move(p));
  if (!problems.empty()) throw SetupError(problems);
}

}  // namespace muro
