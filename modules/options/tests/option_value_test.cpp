// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/option_table.h>

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
enum class Colour
{
  Red,
  Green
};

struct Lamp
{
  double angle = 0.5;
  int count = 3;
  std::uint64_t seed = 1;
  std::int64_t start_ns = 0;
  bool on = true;
  Colour colour = Colour::Red;
  std::string label;
  Vec3 place = Vec3::Zero();
  Pose pose;
  std::optional<Pose> other;
  std::vector<double> rows;
};

struct House
{
  Lamp lamp;
};

const OptionTable<Lamp>& lampTable()
{
  static const OptionTable<Lamp> table = {
      {"lamp.angle", "deg", number(&Lamp::angle, 0.0, 90.0, 0.5), "angle", OptionTier::Main},
      {"lamp.count", "", wholeNumber(&Lamp::count, 0, 5), "number"},
      {"lamp.seed", "", valueAs<SeedValue>(&Lamp::seed), "seed"},
      {"lamp.start", "s", valueAs<EpochValue>(&Lamp::start_ns), "start"},
      {"lamp.on", "", valueAs<BooleanValue>(&Lamp::on), "on"},
      {"colour", "", choice(&Lamp::colour, {"red", "green"}), "colour"},
      {"label", "", valueAs<RegexValue>(&Lamp::label), "label"},
      {"place", "m", valueAs<VectorValue>(&Lamp::place), "place"},
      {"pose", "", valueAs<PoseValue>(&Lamp::pose), "pose"},
      {"other", "", valueAs<OptionalPoseValue>(&Lamp::other), "other"},
      {"rows", "",
       [](Lamp& l) -> OptionValue {
         return NumbersValue{&l.rows, 2, 3, 10.0, "rows of two"};
       },
       "rows"},
  };
  return table;
}

/** The message of assign(); "ok" when it returns none. */
std::string assigned(Lamp& lamp, std::string_view key, std::string_view text)
{
  const auto* row = findOption(lampTable(), key);
  return assign(row->value(lamp), row->unit, text).value_or("ok");
}

std::string textOf(const Lamp& lamp, std::string_view key)
{
  return valueText(*findOption(lampTable(), key), lamp);
}
}  // namespace

TEST(OptionValue, EveryKindReadsBackWhatItPrints)
{
  Lamp lamp;
  using Case = std::pair<const char*, const char*>;
  for (const auto& [key, text] :
       {Case{"lamp.angle", "30"}, Case{"lamp.count", "5"},
        Case{"lamp.seed", "18446744073709551615"}, Case{"lamp.start", "1700000000"},
        Case{"lamp.on", "false"}, Case{"colour", "green"}, Case{"place", "[1, -2, 0.5]"},
        Case{"pose", "[1, 2, 3, 90, 0, -5]"}, Case{"other", "[0, 0, 1, 0, 0, 0]"},
        Case{"other", "null"}, Case{"rows", "[]"}, Case{"rows", "[1, -2.5]"},
        Case{"rows", "[[1, 2], [3, 4]]"}})
  {
    EXPECT_EQ(assigned(lamp, key, text), "ok") << key;
    EXPECT_EQ(textOf(lamp, key), text) << key;
  }
  EXPECT_EQ(lamp.angle, 15.0);
  EXPECT_EQ(lamp.start_ns, 1'700'000'000'000'000'000);
  EXPECT_EQ(assigned(lamp, "place", "3,4,5"), "ok");
  EXPECT_EQ(lamp.place, Vec3(3, 4, 5));
  EXPECT_EQ(assigned(lamp, "label", "it's"), "ok");
  EXPECT_EQ(textOf(lamp, "label"), "'it''s'");
}

TEST(OptionValue, WhatIsNotAllowedIsRefusedAndChangesNothing)
{
  Lamp lamp;
  using Case = std::array<const char*, 3>;
  for (const auto& [key, text, part] :
       {Case{"rows", "[1, 2, 3]", "has 3 numbers; allowed: rows of two"},
        Case{"rows", "1,2,3,4,5,6,7,8", "has 8 numbers"}, Case{"rows", "[1, 11]", "the number 11"},
        Case{"rows", "[1, x]", "'x' is not a list of numbers"},
        Case{"lamp.angle", "91", "91 is out of range; allowed: 0 to 90 deg"},
        Case{"lamp.angle", "nan", "'nan' is not a number"},
        Case{"lamp.count", "1.5", "'1.5' is not a whole number; allowed: 0 to 5"},
        Case{"lamp.count", "6", "out of range"}, Case{"lamp.seed", "-1", "not a whole number"},
        Case{"lamp.start", "-5", "out of range"},
        Case{"lamp.start", "9000000000000000000", "out of range"},
        Case{"lamp.on", "yes", "'yes' is not a boolean; allowed: true, false"},
        Case{"colour", "blue", "'blue' is not a choice; allowed: red, green"},
        Case{"label", "(", "is not a regular expression"},
        Case{"place", "1,2", "'1,2' is not a vector"},
        Case{"pose", "[1, 2, 3, 4, 5, x]", "'x' is not a pose"},
        Case{"other", "7", "'7' is not a pose"}})
  {
    const std::string before = textOf(lamp, key);
    EXPECT_NE(assigned(lamp, key, text).find(part), std::string::npos)
        << key << ": " << assigned(lamp, key, text);
    EXPECT_EQ(textOf(lamp, key), before);
  }
}

TEST(OptionTable, ListsWhatIsWrong)
{
  Lamp lamp;
  EXPECT_TRUE(problemsOf(lampTable(), lamp).empty());
  lamp.count = 9;
  lamp.pose.R *= 2.0;
  const auto problems = problemsOf(lampTable(), lamp);
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_EQ(problems[0], "lamp.count: 9 is out of range; allowed: 0 to 5");
  EXPECT_EQ(problems[1], "pose: has a matrix that is not a rotation");
}

TEST(OptionTable, RowsOfAPartReachTheWhole)
{
  const OptionTable<House> table = rowsOf(lampTable(), &House::lamp);
  House house;
  ASSERT_EQ(table.size(), lampTable().size());
  EXPECT_FALSE(assign(table[1].value(house), "", "2"));
  EXPECT_EQ(house.lamp.count, 2);
  EXPECT_EQ(table[0].tier, OptionTier::Main);
  EXPECT_EQ(table[1].tier, OptionTier::Expert);
  EXPECT_EQ(nearestKey(table, "lamp.cuont"), "lamp.count");
  EXPECT_EQ(groupOf("lamp.count"), "lamp");
  EXPECT_EQ(nameOf("colour"), "colour");
}

TEST(OptionTable, TextsKeepWhatIsText)
{
  Lamp lamp;
  lamp.label = "[1]";
  const auto texts = textsOf(lampTable(), lamp);
  EXPECT_EQ(texts[6].text, "[1]");
  EXPECT_TRUE(texts[6].is_text);
  EXPECT_EQ(texts[4].text, "true");
  EXPECT_FALSE(texts[4].is_text);
}

}  // namespace fastlio
