#ifndef LIGHT_FIELD_DEPTH_SRC_EVALUATION_FIGURE_TEXT_H
#define LIGHT_FIELD_DEPTH_SRC_EVALUATION_FIGURE_TEXT_H

#include <array>
#include <cstdio>
#include <string>

namespace light_field_depth
{
/// "mse_100 1.234  badpix_007 ...", three decimals each, in one line. @param figures pairs of name and value
template <class Figures>
std::string figureText(const Figures& figures)
{
  std::string text;
  for (const auto& [name, value] : figures)
  {
    std::array<char, 64> figure{};
    std::snprintf(figure.data(), figure.size(), "%s %.3f", name, value);
    text.append(text.empty() ? "" : "  ").append(figure.data());
  }
  return text;
}

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_EVALUATION_FIGURE_TEXT_H
