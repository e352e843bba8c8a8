#include <string>

#include <gtest/gtest.h>

#include "light_field_depth/core/enum_names.h"

namespace light_field_depth
{
namespace
{
enum class Side
{
  Left,
  Right,
  Both
};

constexpr EnumNames<Side, 3> SIDE_NAMES = {
    {{Side::Left, "left"}, {Side::Right, "right"}, {Side::Both, "both"}}};

TEST(EnumNames, ReadWhatTheyWrite)
{
  for (const Side side : {Side::Left, Side::Right, Side::Both})
  {
    EXPECT_EQ(enumValue(SIDE_NAMES, enumName(SIDE_NAMES, side), "side"), side);
  }
  EXPECT_EQ(enumName(SIDE_NAMES, Side::Right), "right");
}

TEST(EnumNames, AnUnknownNameIsAnsweredWithAllOthers)
{
  try
  {
    enumValue(SIDE_NAMES, "Left", "side");
    FAIL() << "a name in another case is another name";
  }
  catch (const InputError& error)
  {
    EXPECT_EQ(std::string(error.what()), "There is no side 'Left'; choose left, right or both.");
  }
}

}  // namespace
}  // namespace light_field_depth
