// SPDX-License-Identifier: MIT
#include "core/property_store.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "muro/vocabulary.hpp"

namespace muro {
namespace {

constexpr Key<double> speed{"speed", "m/s", "how fast"};
constexpr Key<double> speed_in_knots{"speed", "kn", "how fast"};
constexpr Key<float> speed_as_float{"speed", "m/s", "how fast"};
constexpr Key<double> wish{"wish", "m/s", "wanted speed", Role::command};

struct PropertyStoreTest : ::testing::Test {
  PropertyStore store;
  Accessor writer = store.add_accessor("a.motion (motion.x)");
  Accessor reader = store.add_accessor("b.laser (laser.y)");
  ObjectId a{0}, b{1}, c{2};

  PropertyStoreTest() {
    for (const char* name : {"a", "b", "c"}) store.add_object(name);
  }
  template <class T>
  T* bind(Accessor p, ObjectId o, const Key<T>& key, Usage usage, const T* initial = nullptr) {
    return static_cast<T*>(store.bind(p, o, key, usage, Multiplicity::single, 1, initial));
  }
  std::string problems() {
    try {
      store.check([](std::string_view key) { return key == "speed" ? "motion.x, motion.z" : ""; });
    } catch (const SetupError& e) {
      return e.what();
    }
    return "";
  }
};

TEST_F(PropertyStoreTest, ReaderAndWriterSeeOnePlaceInAnyOrder) {
  const double* in = bind(reader, a, speed, usage::read);
  const double initial = 3;
  double* out = bind(writer, a, speed, usage::variable, &initial);
  EXPECT_EQ(in, out);
  EXPECT_EQ(*in, 3);
  EXPECT_EQ(problems(), "");
}

TEST_F(PropertyStoreTest, ValuesOfOneKeyLieSideBySideAndNeverMove) {
  std::vector<double*> places;
  for (int i = 0; i < 5000; ++i) {
    store.add_object("x" + std::to_string(i));
    places.push_back(bind(writer, ObjectId(3 + i), speed, usage::variable));
    *places.back() = i;
  }
  EXPECT_EQ(places[1], places[0] + 1);
  for (int i = 0; i < 5000; ++i) EXPECT_EQ(*places[std::size_t(i)], i);
}

TEST_F(PropertyStoreTest, SharingDeclaredBeforeCreationMakesOnePlace) {
  store.share(a, speed, b, speed);
  EXPECT_EQ(bind(writer, a, speed, usage::variable), bind(reader, b, speed, usage::read));
  EXPECT_EQ(problems(), "");
}

TEST_F(PropertyStoreTest, SharingDeclaredAfterCreationMakesOnePlace) {
  double* out = bind(writer, a, speed, usage::variable);
  store.share(b, speed, a, speed);
  EXPECT_EQ(bind(reader, b, speed, usage::read), out);
  EXPECT_EQ(problems(), "");
}

TEST_F(PropertyStoreTest, SharingChainsAndConstantsAreShared) {
  store.share(a, speed, b, speed);
  store.share(c, speed, b, speed);
  const double v = 7;
  store.set_constant(c, speed, &v, single_value);
  EXPECT_EQ(*bind(reader, a, speed, usage::read), 7);
  EXPECT_EQ(problems(), "");
}

TEST_F(PropertyStoreTest, SharingTwoWrittenPropertiesIsAnError) {
  bind(writer, a, speed, usage::variable);
  bind(reader, b, speed, usage::variable);
  store.share(a, speed, b, speed);
  EXPECT_EQ(problems(),
            "`a:speed` and `b:speed` have values of their own already (bound by a.motion (motion.x), b.laser "
            "(laser.y)); declare the "
            "sharing before algorithms connect");
}

TEST_F(PropertyStoreTest, SharingDifferentTypesIsAnError) {
  store.share(a, speed, b, keys::pose);
  EXPECT_EQ(problems(),
            "`a:speed` and `b:pose` cannot share one place: type f64 in \"m/s\" and type muro.Pose in \"m\"");
}

TEST_F(PropertyStoreTest, TwoWritersOfASharedPropertyAreNamed) {
  store.share(a, speed, b, speed);
  bind(writer, a, speed, usage::variable);
  bind(reader, b, speed, usage::variable);
  EXPECT_NE(problems().find(
                "has two writers: a.motion (motion.x) and b.laser (laser.y); only one algorithm may write a property"),
            std::string::npos);
}

TEST_F(PropertyStoreTest, AReadThatNobodyWritesNamesReaderAndHelp) {
  bind(reader, b, speed, usage::read);
  EXPECT_EQ(problems(),
            "`b:speed` (how fast) is read by b.laser (laser.y), but nothing writes it; add one of: motion.x, motion.z");
}

TEST_F(PropertyStoreTest, ACommandThatNobodyUsesIsAnErrorUnlessItIsAnOffer) {
  bind(writer, a, wish, usage::optional_output);
  EXPECT_EQ(problems(), "");
  bind(writer, b, wish, usage::write);
  EXPECT_EQ(problems(),
            "`b:wish` (wanted speed) is commanded by a.motion (motion.x), but nothing that moves `b` uses this "
            "command; choose another "
            "motion algorithm, or add a drive");
  bind(reader, b, wish, usage::input);
  EXPECT_EQ(problems(), "");
}

TEST_F(PropertyStoreTest, UnitsAndTypesAreComparedAndBothSidesNamed) {
  bind(writer, a, speed, usage::variable);
  bind(reader, a, speed_in_knots, usage::read);
  bind(reader, a, speed_as_float, usage::read);
  EXPECT_NE(
      problems().find(
          "property `speed`: unit \"m/s\" and unit \"kn\" are declared by a.motion (motion.x) and b.laser (laser.y); "
          "use one unit, or another name\nproperty `speed`: type f64 and type f32 are declared by a.motion (motion.x) "
          "and "
          "b.laser (laser.y); give the property of one of them another name"),
      std::string::npos)
      << problems();
}

TEST_F(PropertyStoreTest, RolesAreComparedAndBothSidesNamed) {
  constexpr Key<double> speed_as_trait{"speed", "m/s", "how fast", Role::motion_trait};
  bind(writer, a, speed, usage::variable);
  bind(reader, a, speed_as_trait, usage::read);
  EXPECT_NE(
      problems().find("property `speed`: role state and role motion_trait are declared by a.motion (motion.x) and "
                      "b.laser (laser.y); declare the key in one place, as the vocabulary does"),
      std::string::npos)
      << problems();
}

TEST_F(PropertyStoreTest, TypesThatGrowAreForConstants) {
  const Shape shape = Shape::sphere(1);
  store.set_constant(a, keys::collision_shapes, &shape, 1);
  EXPECT_EQ(problems(), "");
  store.bind(reader, a, keys::collision_shapes, usage::read, Multiplicity::array, 0, nullptr);
  EXPECT_NE(
      problems().find("`a:collision.shapes` is used by b.laser (laser.y), but its type muro.Shape is for constants"),
      std::string::npos)
      << problems();
}

TEST_F(PropertyStoreTest, LengthsOfArraysAreCompared) {
  store.bind(writer, a, speed, usage::variable, Multiplicity::array, 3, nullptr);
  store.bind(reader, a, speed, usage::read, Multiplicity::array, 4, nullptr);
  EXPECT_NE(
      problems().find("`a:speed` is an array of 3 for a.motion (motion.x) and an array of 4 for b.laser (laser.y)"),
      std::string::npos);
}

TEST_F(PropertyStoreTest, AReaderOfAnArrayMayComeBeforeItsWriter) {
  const ArrayIn<double> in(store.bind(reader, a, speed, usage::read, Multiplicity::array, 0, nullptr));
  const ArrayOut<double> out(store.bind(writer, a, speed, usage::variable, Multiplicity::array, 3, nullptr));
  (*out)[2] = 5;
  ASSERT_EQ((*in).size(), 3u);
  EXPECT_EQ((*in)[2], 5);
}

TEST_F(PropertyStoreTest, ASumAddsTheSlotsOfAllWhoContribute) {
  const SumIn<Wrench> in(
      store.bind(reader, a, keys::external_wrench, usage::read_sum, Multiplicity::single, 1, nullptr));
  EXPECT_EQ(in.value().force.x(), 0);
  const Sum<Wrench> one(
      store.bind(writer, a, keys::external_wrench, usage::accumulate, Multiplicity::single, 1, nullptr));
  const Sum<Wrench> two(
      store.bind(writer, a, keys::external_wrench, usage::accumulate, Multiplicity::single, 1, nullptr));
  one->force.x() = 1;
  two->force.x() = 2;
  EXPECT_EQ(in.value().force.x(), 3);
  EXPECT_EQ(problems(), "");
}

TEST_F(PropertyStoreTest, AddingToWhatAnotherWritesIsAnError) {
  bind(writer, a, keys::external_wrench, usage::variable);
  store.bind(reader, a, keys::external_wrench, usage::accumulate, Multiplicity::single, 1, nullptr);
  EXPECT_NE(
      problems().find("is written by a.motion (motion.x) and added to by b.laser (laser.y); all of them must add"),
      std::string::npos);
}

TEST_F(PropertyStoreTest, WritingAConstantIsAnError) {
  const double v = 1;
  store.set_constant(a, speed, &v, single_value);
  bind(writer, a, speed, usage::variable);
  EXPECT_EQ(problems(), "`a:speed` is a constant, but a.motion (motion.x) writes it");
}

TEST_F(PropertyStoreTest, ASumThatSomebodyWritesIsAnError) {
  bind(writer, a, keys::external_wrench, usage::variable);
  store.bind(reader, a, keys::external_wrench, usage::read_sum, Multiplicity::single, 1, nullptr);
  EXPECT_NE(problems().find("is written by a.motion (motion.x), but b.laser (laser.y) reads the sum of contributions"),
            std::string::npos);
}

TEST_F(PropertyStoreTest, EmptyAndReplacedConstantsAreWhatWasSetLast) {
  store.set_constant(a, speed, nullptr, 0);
  EXPECT_EQ(store.constant(a, speed).size, 0u);
  const double three[] = {1, 2, 3};
  store.set_constant(a, speed, three, 1);
  const ArrayIn<double> in(store.bind(reader, a, speed, usage::read, Multiplicity::array, 0, nullptr));
  EXPECT_EQ((*in).size(), 1u);
  store.set_constant(b, speed, three, single_value);
  store.set_constant(b, speed, three, 3);
  EXPECT_EQ(store.constant(b, speed).size, 3u);
}

TEST_F(PropertyStoreTest, StateBlocksBeginAlignedForAnyType) {
  for (const char* name : {"x", "y", "z"})
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(store.state_block(writer, a, name, 12)) % 64, 0u);
}

TEST_F(PropertyStoreTest, AnImageOfAnotherStoreIsRefusedAndChangesNothing) {
  const double v = 4;
  double* out = bind(writer, a, speed, usage::variable, &v);
  PropertyStore other;
  other.add_object("a");
  EXPECT_THROW(store.load(other.save()), SetupError);
  EXPECT_EQ(*out, 4);
}

TEST_F(PropertyStoreTest, AnImageBringsBackValuesAndLists) {
  double* out = bind(writer, a, speed, usage::variable);
  const ListOut<Contact> list(store.bind(writer, a, keys::contacts, usage::derived, Multiplicity::list, 0, nullptr));
  *out = 1;
  for (int i = 0; i < 20; ++i) list.push_back({.depth = double(i)});
  const PropertyStore::Image image = store.save();
  const std::uint64_t hash = store.hash(a);
  *out = 2;
  list.clear();
  EXPECT_NE(store.hash(a), hash);
  store.load(image);
  EXPECT_EQ(*out, 1);
  EXPECT_EQ(store.hash(a), hash);
  ASSERT_EQ((*list).size(), 20u);
  EXPECT_EQ((*list)[19].depth, 19);
}

TEST_F(PropertyStoreTest, TheHashSeesEveryBitOfAVariableAndNothingElse) {
  double* out = bind(writer, a, speed, usage::variable);
  auto* derived = bind(writer, a, keys::pose, usage::derived);
  const std::uint64_t before = store.hash(a);
  derived->position.x() = 1;
  EXPECT_EQ(store.hash(a), before);
  *out = -0.0;
  EXPECT_NE(store.hash(a), before);
}

TEST_F(PropertyStoreTest, ClearingMakesValuesZeroAndListsEmpty) {
  double* out = bind(writer, a, speed, usage::variable);
  const SlotId number = store.slots_of(writer).back();
  const KeyInfo key = keys::contacts;
  auto* list = static_cast<ListHeader*>(store.bind(writer, a, key, usage::variable, Multiplicity::list, 0, nullptr));
  const SlotId contacts = store.slots_of(writer).back();
  *out = 3;
  list->size = 2;
  store.clear(number);
  store.clear(contacts);
  EXPECT_EQ(*out, 0);
  EXPECT_EQ(list->size, 0u);
}

TEST_F(PropertyStoreTest, MemoryPartitionsLieAPageApart) {
  constexpr std::ptrdiff_t page = 4096;
  store.set_partitions({1, 1, 2});
  const auto* const of_a = reinterpret_cast<const char*>(bind<double>(writer, a, speed, usage::variable));
  const auto* const of_b = reinterpret_cast<const char*>(bind<double>(writer, b, speed, usage::variable));
  const auto* const of_c = reinterpret_cast<const char*>(bind<double>(writer, c, speed, usage::variable));
  EXPECT_EQ(of_b - of_a, std::ptrdiff_t(sizeof(double)));
  EXPECT_GE(of_c - of_b, page);
}

}  // namespace
}  // namespace muro
