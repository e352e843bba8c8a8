#include "light_field_depth/core/multiview/sequence.h"

#include <sstream>
#include <utility>

namespace light_field_depth::multiview
{
namespace
{
/// Text that differs whenever the views or the settings do.
std::string signatureOf(const LightField& light_field, const std::string& settings)
{
  std::ostringstream text;
  text.precision(17);
  const cv::Mat& image = light_field.reference().image;
  text << settings << ' ' << image.cols << ' ' << image.rows << ' ' << image.type() << ' '
       << light_field.reference_index;
  for (const View& view : light_field.views)
  {
    text << ' ' << view.steps.x << ' ' << view.steps.y << ' ' << view.offset_px.x << ' ' << view.offset_px.y;
  }
  return text.str();
}

}  // namespace

const SceneMeasures* Sequence::follow(const LightField& light_field, const std::string& settings)
{
  std::string signature = signatureOf(light_field, settings);
  const bool follows = unbroken_ && signature == signature_;
  unbroken_ = false;
  signature_ = std::move(signature);
  return follows ? &measures_ : nullptr;
}

void Sequence::begin(SceneMeasures measures)
{
  measures_ = std::move(measures);
  unbroken_ = true;
}

}  // namespace light_field_depth::multiview
