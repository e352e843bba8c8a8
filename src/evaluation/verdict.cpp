#include "light_field_depth/evaluation/verdict.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <utility>

#include "evaluation/view_exchange.h"
#include "evaluation/view_samples.h"
#include "light_field_depth/core/depth_sign.h"
#include "light_field_depth/core/view_layout.h"
#include "light_field_depth/core/view_places.h"

namespace light_field_depth
{
namespace
{
using Severity = Finding::Severity;

std::string fixed(double value, int decimals)
{
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::string percent(double share)
{
  return fixed(100.0 * share, 0) + " %";
}

std::string viewText(const LightField& light_field, std::size_t index)
{
  return "view " + toString(light_field.views[index].grid);
}

/// Adds the text of a warning or of a fine finding, whichever it is.
void add(Verdict& verdict, const char* name, bool warning, double value, std::string sentence)
{
  verdict.findings.push_back(
      {name, warning ? Severity::Warning : Severity::Fine, value, std::move(sentence)});
}

/// Every so-manieth pixel, in brightness or in the first channel: enough to know an image by.
std::vector<float> sparsePixels(const cv::Mat& image)
{
  constexpr int ROWS = 48;  // some thousand pixels
  std::vector<float> values;
  const int pitch = std::max(1, image.rows / ROWS);
  const int channels = image.channels();
  const int middle = channels / 2;
  for (int y = pitch / 2; y < image.rows; y += pitch)
  {
    for (int x = pitch / 2; x < image.cols; x += pitch)
    {
      values.push_back(image.depth() == CV_8U
                           ? static_cast<float>(image.ptr<std::uint8_t>(y)[x * channels + middle])
                           : static_cast<float>(image.ptr<std::uint16_t>(y)[x * channels + middle]));
    }
  }
  return values;
}

double deviationOf(const std::vector<float>& values)
{
  double sum = 0.0;
  double squares = 0.0;
  for (const float value : values)
  {
    sum += value;
    squares += static_cast<double>(value) * value;
  }
  const auto n = static_cast<double>(values.size());
  return std::sqrt(std::max(squares / n - sum * sum / (n * n), 0.0));
}

/// Between the first and the last hundredth.
double spanOf(std::vector<float> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t hundredth = values.size() / 100;
  return values[values.size() - 1 - hundredth] - values[hundredth];
}

void judgeImages(const LightField& light_field, const LightField& bytes, const VerdictOptions& options,
                 Verdict& verdict)
{
  std::map<std::vector<float>, std::size_t> known;
  for (std::size_t i = 0; i < bytes.views.size(); ++i)
  {
    std::vector<float> pixels = sparsePixels(bytes.views[i].image);
    const double contrast = deviationOf(pixels);
    if (contrast < options.min_contrast_levels)
    {
      add(verdict, "blank view", true, contrast,
          "The " + viewText(light_field, i) + " has nothing in it but one brightness (deviation " +
              fixed(contrast, 2) + " levels); leave it out, or record it again.");
      continue;
    }
    const auto [place, is_new] = known.emplace(std::move(pixels), i);
    if (!is_new)
    {
      add(verdict, "identical views", true, 1.0,
          "The " + viewText(light_field, i) + " is the same image as " +
              viewText(light_field, place->second) +
              "; give each place its own image, or leave one of them out.");
    }
  }
  const double levels = spanOf(sparsePixels(bytes.reference().image));
  const bool converted = light_field.reference().image.depth() != CV_8U;
  const bool few = levels < (converted ? options.min_grey_levels_after_conversion : options.min_grey_levels);
  add(verdict, "grey levels", few, levels,
      "The reference view spans " + fixed(levels, 0) + " of 256 grey levels" +
          (converted ? " after its 16 bits have been converted" : "") +
          (few ? "; stretch the views' values, all by the same factor and offset, before they are read."
               : "."));
}

void judgeAgreement(const ViewSamples& samples, const VerdictOptions& options, Verdict& verdict)
{
  const double texture = samples.pixels > 0 ? static_cast<double>(samples.textured) / samples.pixels : 0.0;
  if (texture < options.min_texture)
  {
    add(verdict, "texture", true, texture,
        "Only " + percent(texture) +
            " of the reference view has contrast above its noise, so that there is hardly anything to match; "
            "expose longer or light the scene.");
    return;
  }
  if (texture < options.min_texture_for_agreement)
  {
    add(verdict, "texture", false, texture,
        "Only " + percent(texture) + " of the reference view has contrast above its noise.");
    return;
  }
  const double agreement = static_cast<double>(samples.agreeing) / samples.textured;
  const bool poor = agreement < options.min_agreement;
  add(verdict, "agreement", poor, agreement,
      "The views agree with the reference at " + percent(agreement) + " of the pixels with contrast" +
          (poor ? ", as views do that are not of one scene, not rectified, in a wrong order, or that move "
                  "beyond the range that was searched; check --order, --flip and --disparity-range."
                : "."));
  const double ratio = samples.difference_levels / (samples.noise_levels + 1.0);
  add(verdict, "photometric difference", false, ratio,
      "Where there is contrast, the views differ from the reference by " +
          fixed(samples.difference_levels, 1) + " levels, with noise of " + fixed(samples.noise_levels, 1) +
          ".");
}

void judgeViews(const LightField& light_field, const ViewSamples& samples, const VerdictOptions& options,
                Verdict& verdict)
{
  constexpr int MIN_SEEN = 50;  // pixels; a share of fewer is good to no more than 7 %
  std::vector<double> shares;
  for (const ViewAgreement& view : samples.views)
  {
    if (view.seen >= MIN_SEEN)
    {
      shares.push_back(view.share());
    }
  }
  if (shares.empty())
  {
    return;
  }
  const auto middle = shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2);
  std::nth_element(shares.begin(), middle, shares.end());
  const ViewAgreement* worst = nullptr;
  double most_px = 0.0;
  for (const ViewAgreement& view : samples.views)
  {
    if (view.seen < MIN_SEEN)
    {
      continue;
    }
    if (*middle >= options.min_agreement && view.share() < options.min_view_agreement &&
        view.share() < options.min_relative_view_agreement * *middle)
    {
      add(verdict, "view", true, view.share(),
          "The " + viewText(light_field, view.view_index) + " agrees with the reference at only " +
              percent(view.share()) + " of the pixels, half of the views at " + percent(*middle) +
              " or more; check that it shows the same scene, upright, and stands where it claims to.");
    }
    const double shift_px = std::hypot(view.shift_px.x, view.shift_px.y);
    if (shift_px > most_px)
    {
      most_px = shift_px;
      worst = &view;
    }
  }
  if (worst != nullptr)
  {
    const bool off = most_px > options.max_misregistration_px;
    add(verdict, "registration", off, most_px,
        "The " + viewText(light_field, worst->view_index) + " is off its place by " +
            fixed(worst->shift_px.x, 2) + " px to the right and " + fixed(worst->shift_px.y, 2) +
            " px down on the whole" + (off ? "; rectify the views, or give them a calibration." : "."));
  }
}

void judgeExchanges(const LightField& light_field, const cv::Mat& disparity, const VerdictOptions& options,
                    ThreadPool& pool, Verdict& verdict)
{
  const std::vector<ViewExchange> exchanges =
      findExchanges(light_field, disparity, options.min_exchange_significance, pool);
  for (const ViewExchange& exchange : exchanges)
  {
    add(verdict, "exchanged views", true, exchange.significance,
        "The " + viewText(light_field, exchange.first) + " and " + viewText(light_field, exchange.second) +
            " have changed places, as what is near and far in them tells; check the order of the files.");
  }
}

void judgeFilled(const cv::Mat& filled, const VerdictOptions& options, Verdict& verdict)
{
  if (filled.empty())
  {
    return;
  }
  const double share = static_cast<double>(cv::countNonZero(filled)) / static_cast<double>(filled.total());
  const bool most = share > options.max_filled;
  add(verdict, "filled", most, share,
      percent(share) + " of the map is filled from what lies around it, where the views tell nothing" +
          (most ? "; light or mark what is blank there, or believe only what the confidence map shows."
                : "."));
}

void judgeRange(const ViewSamples& samples, const DisparityRange& range, const VerdictOptions& options,
                Verdict& verdict)
{
  constexpr float SHARE_OF_RANGE = 0.01F;  // that counts as its end: a label or so
  if (samples.disparities.empty() || !(range.max > range.min))
  {
    return;
  }
  const float margin = SHARE_OF_RANGE * (range.max - range.min);
  const auto count = static_cast<double>(samples.disparities.size());
  const auto share = [&](const auto& is_there)
  {
    return static_cast<double>(
               std::count_if(samples.disparities.begin(), samples.disparities.end(), is_there)) /
           count;
  };
  const double at_max = share([&](float d) { return d >= range.max - margin; });
  // Parallel cameras have nothing below zero, and distant scenes much of it there.
  const double at_min = range.min == 0.0F ? 0.0 : share([&](float d) { return d <= range.min + margin; });
  const double most = std::max(at_min, at_max);
  const bool cut_off = most > options.max_share_at_bound;
  add(verdict, "range", cut_off, most,
      percent(most) + " of the pixels with contrast lie at one end of the range of " + fixed(range.min, 2) +
          " .. " + fixed(range.max, 2) + " px" + (cut_off ? "; give a wider --disparity-range." : "."));
}

void putWarningsFirst(Verdict& verdict)
{
  std::stable_sort(verdict.findings.begin(), verdict.findings.end(),
                   [](const Finding& a, const Finding& b)
                   { return a.severity == Severity::Warning && b.severity != Severity::Warning; });
}

void judgeLayout(const LightField& light_field, ThreadPool& pool, Verdict& verdict)
{
  const FoundLayout found = findLayout(light_field, pool);
  const bool wrong = found.decided && (found.layout.transposed || found.layout.mirrored);
  std::string sentence = "The images do not tell the layout of the views.";
  if (wrong)
  {
    sentence = std::string("The images fit a grid whose ") +
               (found.layout.transposed ? "rows and columns are taken for each other" : "") +
               (found.layout.transposed && found.layout.mirrored ? ", and whose " : "") +
               (found.layout.mirrored ? "rows or columns run backwards" : "") +
               "; correct the order of the views.";
  }
  else if (found.decided)
  {
    sentence = "The images confirm the layout of the views.";
  }
  add(verdict, "order", wrong, found.ratio, sentence);
  if (wrong)
  {
    return;
  }
  const DepthSign sign = findDepthSign(light_field, pool);
  add(verdict, "sign", sign.reversed, sign.share,
      sign.reversed
          ? "What is near hides what should be nearer: the disparities have the wrong sign, near is "
            "far; turn the order of both rows and columns round."
      : sign.decided ? "Occlusions confirm that large disparities are near."
                     : "Occlusions do not tell the sign of the disparities.");
}

void judgePlaces(const LightField& light_field, ThreadPool& pool, Verdict& verdict)
{
  const ViewPlaces places = checkViewPlaces(light_field, pool);
  if (!places.checked)
  {
    return;
  }
  if (places.shuffled)
  {
    add(verdict, "places", true, static_cast<double>(places.doubts.size()),
        std::to_string(places.doubts.size()) + " of " + std::to_string(light_field.views.size()) +
            " views do not fit the places that they claim: their order is wrong, or the shape of the grid; "
            "check "
            "how the files are numbered, and --grid.");
    return;
  }
  for (const ViewDoubt& doubt : places.doubts)
  {
    const bool foreign = doubt.kind == ViewDoubt::Kind::Foreign;
    add(verdict, foreign ? "foreign view" : "misplaced view", true, doubt.cost,
        "The " + viewText(light_field, doubt.view_index) +
            (foreign
                 ? " fits no place of this light field; leave it out, or check that it shows the same scene, "
                   "upright."
                 : " fits the place " + toString(doubt.better_place) +
                       " far better than its own; check the order of the files."));
  }
  if (places.doubts.empty())
  {
    add(verdict, "places", false, 0.0, "Every view fits the place that it claims.");
  }
}

}  // namespace

std::string toString(Finding::Severity severity)
{
  return severity == Severity::Warning ? "warning" : "fine";
}

bool Verdict::isDoubtful() const
{
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& finding) { return finding.severity == Severity::Warning; });
}

std::vector<std::string> Verdict::warnings() const
{
  std::vector<std::string> sentences;
  for (const Finding& finding : findings)
  {
    if (finding.severity == Severity::Warning)
    {
      sentences.push_back(finding.sentence);
    }
  }
  return sentences;
}

Verdict judgeResult(const LightField& light_field, const DisparityEstimate& estimate, ThreadPool& pool,
                    const VerdictOptions& options)
{
  Verdict verdict;
  const LightField bytes = toEightBit(light_field);
  judgeImages(light_field, bytes, options, verdict);
  const ViewSamples samples = sampleViews(bytes, estimate.disparity, pool);
  judgeAgreement(samples, options, verdict);
  judgeFilled(estimate.filled, options, verdict);
  judgeViews(light_field, samples, options, verdict);
  judgeExchanges(bytes, estimate.disparity, options, pool, verdict);
  judgeRange(samples, estimate.range, options, verdict);
  putWarningsFirst(verdict);
  return verdict;
}

Verdict judgeOrder(const LightField& light_field, ThreadPool& pool, bool with_layout)
{
  Verdict verdict;
  if (with_layout)
  {
    judgeLayout(light_field, pool, verdict);
  }
  if (!verdict.isDoubtful())
  {
    judgePlaces(light_field, pool, verdict);
  }
  putWarningsFirst(verdict);
  return verdict;
}

}  // namespace light_field_depth
