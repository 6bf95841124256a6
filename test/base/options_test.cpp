#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/base/options.h"
#include "support/error_text.h"
#include "support/option_laws.h"

namespace grid_path_planner::base {
namespace {

using test::contains;
using test::errorText;

enum class Colour { RED, GREEN };
const std::vector<std::pair<const char*, Colour>>& choicesOf(Colour) {
  static const std::vector<std::pair<const char*, Colour>> choices = {{"red", Colour::RED},
                                                                      {"green", Colour::GREEN}};
  return choices;
}

struct PaintOptions {
  double width = 0.5;
  int layers = 2;
  bool glossy = false;
  std::string name = "wall";
  Colour colour = Colour::GREEN;
};

template <class Visitor>
void visitOptions(PaintOptions& o, Visitor&& visit) {
  visit("width", o.width, OptionInfo{"Width of the brush", "m", 0.001, 1.0});
  visit("layers", o.layers, OptionInfo{"How many times it is painted over", "", 1, 10});
  visit("glossy", o.glossy, OptionInfo{"Whether it shines afterwards", ""});
  visit("name", o.name, OptionInfo{"What is painted", ""});
  visit("colour", o.colour, OptionInfo{"Colour of the paint", ""}.under("Looks"));
}

TEST(Options, TheClosestNameIsFoundWhereOneIsLikeIt) {
  const std::vector<std::string> known = {"radius", "decay", "kernel"};
  EXPECT_EQ(closestName("raduis", known), "radius");
  EXPECT_EQ(closestName("kernl", known), "kernel");
  EXPECT_EQ(closestName("tolerance", known), "");
  EXPECT_EQ(closestName("radius", {}), "");
}

TEST(Options, AllHoldToTheLaws) {
  test::expectOptionLaws<PaintOptions>();
}

TEST(Options, LimitsAreInclusive) {
  for (const double width : {0.001, 1.0}) {
    PaintOptions options;
    options.width = width;
    EXPECT_NO_THROW(checkOptionLimits(options)) << width;
  }
}

TEST(Options, ARefusalNamesOptionLimitsUnitAndValue) {
  const auto refusal = [](double width, int layers) {
    PaintOptions options;
    options.width = width;
    options.layers = layers;
    return errorText([&] { checkOptionLimits(options); });
  };
  EXPECT_EQ(refusal(1.5, 2), "width must be a number from 0.001 to 1 m, got 1.5");
  EXPECT_EQ(refusal(-1e-7, 2), "width must be a number from 0.001 to 1 m, got -1e-07");
  EXPECT_EQ(refusal(0.5, 0), "layers must be a number from 1 to 10, got 0");
  EXPECT_EQ(refusal(0.5, 1000000), "layers must be a number from 1 to 10, got 1000000");
}

TEST(Options, NumbersThatAreNotFiniteAreRefused) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double width : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
    PaintOptions options;
    options.width = width;
    EXPECT_TRUE(contains(errorText([&] { checkOptionLimits(options); }), "width must be"));
  }
  // Even where an option has no limits.
  EXPECT_THROW(checkLimits("x", std::numeric_limits<double>::quiet_NaN(), OptionInfo{"", ""}),
               InputError);
}

TEST(Options, TheFirstOneOutsideIsNamed) {
  PaintOptions options;
  options.width = 2.0;
  options.layers = 0;
  EXPECT_TRUE(contains(errorText([&] { checkOptionLimits(options); }), "width"));
}

TEST(Options, CheckingChangesNothing) {
  PaintOptions options;
  options.layers = 99;
  EXPECT_THROW(checkOptionLimits(options), InputError);
  EXPECT_EQ(options.layers, 99);
}

TEST(Options, UnknownChoicesNameTheKnownOnes) {
  EXPECT_EQ(errorText([] { choiceFromName<Colour>("colour", "Red"); }),
            "colour must be one of red, green, got 'Red'");
  EXPECT_THROW(choiceFromName<Colour>("colour", ""), InputError);
  EXPECT_STREQ(choiceName(static_cast<Colour>(7)), "?");
}

TEST(Options, AsText) {
  EXPECT_EQ(optionText(PaintOptions()),
            "width: 0.5\nlayers: 2\nglossy: false\nname: wall\ncolour: green\n");
}

TEST(Options, Described) {
  const std::vector<OptionDescription> all = describeOptions(PaintOptions());
  ASSERT_EQ(all.size(), 5u);
  EXPECT_EQ(all[0].name, "width");
  EXPECT_EQ(all[0].type, OptionType::NUMBER);
  EXPECT_EQ(all[0].value, "0.5");
  EXPECT_EQ(all[0].description, "Width of the brush");
  EXPECT_EQ(all[0].unit, "m");
  EXPECT_EQ(all[0].minimum, 0.001);
  EXPECT_EQ(all[0].maximum, 1.0);
  EXPECT_EQ(all[1].type, OptionType::WHOLE_NUMBER);
  EXPECT_EQ(all[2].type, OptionType::TRUTH);
  EXPECT_EQ(all[3].type, OptionType::TEXT);
  EXPECT_TRUE(all[3].choices.empty());
  EXPECT_EQ(all[4].type, OptionType::TEXT);
  EXPECT_EQ(all[4].value, "green");
  EXPECT_EQ(all[4].choices, (std::vector<std::string>{"red", "green"}));
  EXPECT_EQ(all[3].heading, "");
  EXPECT_EQ(all[4].heading, "Looks");
}

TEST(Options, TextReadsBackAsTheSameValues) {
  PaintOptions painted;
  painted.width = std::nextafter(0.1, 1.0);
  painted.layers = 7;
  painted.glossy = true;
  painted.name = "a wall: green";
  painted.colour = Colour::RED;
  PaintOptions read;
  for (const OptionDescription& option : describeOptions(painted))
    visitOptions(read, [&](const char* name, auto& value, const OptionInfo& info) {
      if (option.name == name) parseOption(name, option.value, info, value);
    });
  EXPECT_EQ(differingOptions(painted, read), std::vector<std::string>());
}

TEST(Options, ThoseThatDifferAreNamedInTheirOrder) {
  PaintOptions other;
  other.colour = Colour::RED;
  other.layers = 3;
  EXPECT_EQ(differingOptions(PaintOptions(), other),
            (std::vector<std::string>{"layers", "colour"}));
}

TEST(Options, AreTheSameOnlyWhereEveryValueIs) {
  PaintOptions other;
  EXPECT_TRUE(sameOptions(PaintOptions(), other));
  other.width = std::nextafter(other.width, 1.0);
  EXPECT_FALSE(sameOptions(PaintOptions(), other));
  other = {};
  other.colour = Colour::RED;
  EXPECT_FALSE(sameOptions(PaintOptions(), other));
}

}  // namespace
}  // namespace grid_path_planner::base
