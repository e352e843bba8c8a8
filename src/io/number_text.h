#ifndef LIGHT_FIELD_DEPTH_SRC_IO_NUMBER_TEXT_H
#define LIGHT_FIELD_DEPTH_SRC_IO_NUMBER_TEXT_H

#include <locale>
#include <optional>
#include <sstream>
#include <string>

namespace light_field_depth
{
/// The number that a whole text stands for, whatever the locale; white space around it is ignored.
template <class Number>
std::optional<Number> numberFromText(const std::string& text)
{
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  Number number{};
  if (!(stream >> number) || !(stream >> std::ws).eof())
  {
    return std::nullopt;
  }
  return number;
}

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_IO_NUMBER_TEXT_H
