#include "core/multiview/search/sample_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/multiview/search/cost_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
/// No image has a row of this number.
constexpr int NO_ROW = std::numeric_limits<int>::min();
constexpr std::size_t OVERRUN = 64;  ///< bytes that a vector may read or write past the end of a row

int modulo(int value, int divisor)
{
  const int remainder = value % divisor;
  return remainder < 0 ? remainder + divisor : remainder;
}

}  // namespace

void SampleRows::reset(const PreparedView& view, const LabelSpace& labels)
{
  image_ = &view.image;
  stride_ = image_->channelStride();
  shifts_.clear();
  phases_.clear();
  int last_dy = NO_ROW;
  first_dy_ = std::numeric_limits<int>::max();
  for (int label = 0; label < labels.count; ++label)
  {
    const double disparity = labels.disparity(static_cast<float>(label));
    const double shift_x = visibleShift(view.offset_px.x - disparity * view.steps.x, image_->width());
    const double shift_y = visibleShift(view.offset_px.y - disparity * view.steps.y, image_->height());
    const auto x = static_cast<int>(std::lround(SUBPIXEL_PHASES * shift_x));
    const auto y = static_cast<int>(std::lround(SUBPIXEL_PHASES * shift_y));
    const int phase_x = modulo(x, SUBPIXEL_PHASES);
    const int phase_y = modulo(y, SUBPIXEL_PHASES);
    const LabelShift shift{(x - phase_x) / SUBPIXEL_PHASES, (y - phase_y) / SUBPIXEL_PHASES,
                           phaseIndex(phase_x, phase_y), cvFloor(shift_x + 0.5), cvFloor(shift_y + 0.5)};
    first_dy_ = std::min(first_dy_, shift.dy);
    last_dy = std::max(last_dy, shift.dy);
    shifts_.push_back(shift);
  }
  ring_rows_ = last_dy - first_dy_ + 1;
  asked_y_ = 0;
  ring_begin_ = modulo(first_dy_, ring_rows_);
  row_in_slot_.assign(phases_.size() * static_cast<std::size_t>(ring_rows_), NO_ROW);
  values_.resize(row_in_slot_.size() * stride_ * static_cast<std::size_t>(image_->channels()) + OVERRUN);
  scratch_.resize(stride_ + OVERRUN);
}

int SampleRows::phaseIndex(int x, int y)
{
  const auto found = std::find_if(phases_.begin(), phases_.end(),
                                  [&](const Phase& phase) { return phase.x == x && phase.y == y; });
  if (found != phases_.end())
  {
    return static_cast<int>(found - phases_.begin());
  }
  phases_.push_back({x, y});
  return static_cast<int>(phases_.size()) - 1;
}

const std::uint8_t* SampleRows::row(int label, int y)
{
  const LabelShift& where = shifts_[static_cast<std::size_t>(label)];
  const Phase& phase = phases_[static_cast<std::size_t>(where.phase)];
  if (phase.x == 0 && phase.y == 0)
  {
    return image_->row(y + where.dy) + where.dx;
  }
  return slot(where, y) + image_->pad() + where.dx;
}

std::uint8_t* SampleRows::slot(const LabelShift& where, int y)
{
  if (y != asked_y_)
  {
    asked_y_ = y;
    ring_begin_ = modulo(y + first_dy_, ring_rows_);
  }
  const int row = y + where.dy;
  const int place = ring_begin_ + where.dy - first_dy_;
  const auto phase = static_cast<std::size_t>(where.phase);
  const std::size_t index = phase * static_cast<std::size_t>(ring_rows_) +
                            static_cast<std::size_t>(place < ring_rows_ ? place : place - ring_rows_);
  std::uint8_t* const values =
      values_.data() + index * stride_ * static_cast<std::size_t>(image_->channels());
  if (row_in_slot_[index] != row)
  {
    interpolate(phases_[phase], row, values);
    row_in_slot_[index] = row;
  }
  return values;
}

void SampleRows::interpolate(const Phase& phase, int row, std::uint8_t* values)
{
  const int pad = image_->pad();
  const int first_tap = 1;  // the taps reach one pixel to the left and two to the right
  const int count = image_->width() + 2 * pad - 4;
  for (int channel = 0; channel < image_->channels(); ++channel)
  {
    const std::size_t offset = static_cast<std::size_t>(channel) * stride_;
    std::uint8_t* const target = values + offset;
    const auto source = [&](int dy) { return image_->row(row + dy) + offset - pad; };
    const std::uint8_t* line = source(0);
    if (phase.y != 0)
    {
      std::uint8_t* const vertical = phase.x != 0 ? scratch_.data() : target;
      interpolateTaps({source(-1), source(0), source(1), source(2)}, phase.y, count + 4, vertical);
      line = vertical;
    }
    if (phase.x != 0)
    {
      const std::uint8_t* const left = line;
      interpolateTaps({left, left + 1, left + 2, left + 3}, phase.x, count, target + first_tap);
      target[0] = target[first_tap];
      std::fill(target + first_tap + count, target + count + 4, target[count]);
    }
  }
}

}  // namespace light_field_depth::multiview
