#include "core/multiview/sequence.h"

#include <utility>

namespace light_field_depth::multiview
{
Sequence::Signature Sequence::signatureOf(const LightField& light_field, const FrameSettings& settings)
{
  const cv::Mat& image = light_field.reference().image;
  Signature signature{settings, image.size(), image.type(), light_field.reference_index, {}, {}};
  for (const View& view : light_field.views)
  {
    signature.steps.push_back(view.steps);
    signature.offsets_px.push_back(view.offset_px);
  }
  return signature;
}

bool Sequence::agree(const Signature& left, const Signature& right)
{
  const std::optional<DisparityRange>& left_range = left.settings.disparity_range;
  const std::optional<DisparityRange>& right_range = right.settings.disparity_range;
  const bool same_range =
      left_range.has_value() == right_range.has_value() &&
      (!left_range || (left_range->min == right_range->min && left_range->max == right_range->max));
  return same_range && left.settings.options == right.settings.options && left.size == right.size &&
         left.type == right.type && left.reference_index == right.reference_index &&
         left.steps == right.steps && left.offsets_px == right.offsets_px;
}

const SceneMeasures* Sequence::follow(const LightField& light_field, const FrameSettings& settings)
{
  Signature signature = signatureOf(light_field, settings);
  const bool follows = unbroken_ && agree(signature, signature_);
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
