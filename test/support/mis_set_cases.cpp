#include "support/mis_set_cases.h"

#include <utility>

#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/view_layout.h"

namespace light_field_depth::testing
{
namespace
{
constexpr int SIDE = 5;

SyntheticLightField renderRightScene(std::uint32_t seed)
{
  SceneSettings settings;
  settings.size = {160, 120};
  settings.positions = gridPositions(SIDE, SIDE);
  settings.samples = 2;
  settings.noise_sigma = 1.0;
  std::vector<Surface> surfaces = standardScene(settings.size);
  if (seed != 1)
  {
    surfaces = {plane(0.3, 0.004, -0.003, noiseTexture(seed)),
                rectangle(1.5, {40, 30, 50, 40}, noiseTexture(seed + 1, 12.0))};
  }
  return renderScene(surfaces, settings);
}

std::size_t at(int row, int column)
{
  return static_cast<std::size_t>(SIDE * row + column);
}

Spoil relabel(const GridSymmetry& symmetry)
{
  return [=](LightField& field) { field = relabelled(field, symmetry); };
}

/// Gives the view at each place the image of another.
Spoil reorder(const std::function<std::size_t(std::size_t)>& source)
{
  return [=](LightField& field)
  {
    const LightField before = field;
    for (std::size_t i = 0; i < field.views.size(); ++i)
    {
      field.views[i].image = before.views[source(i)].image;
    }
  };
}

Spoil exchange(std::size_t a, std::size_t b)
{
  return [=](LightField& field) { std::swap(field.views[a].image, field.views[b].image); };
}

/// Replaces the images of some views.
Spoil change(const std::vector<std::size_t>& views, const std::function<cv::Mat(const cv::Mat&)>& how)
{
  return [=](LightField& field)
  {
    for (const std::size_t view : views)
    {
      field.views[view].image = how(field.views[view].image);
    }
  };
}

std::vector<std::size_t> allViews()
{
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < static_cast<std::size_t>(SIDE * SIDE); ++i)
  {
    all.push_back(i);
  }
  return all;
}

cv::Mat warped(const cv::Mat& image, const cv::Matx23d& motion)
{
  cv::Mat result;
  cv::warpAffine(image, result, motion, image.size(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  return result;
}

cv::Mat moved(const cv::Mat& image, double x, double y)
{
  return warped(image, {1, 0, x, 0, 1, y});
}

cv::Mat turned(const cv::Mat& image, double degrees, double zoom = 1.0)
{
  const cv::Mat motion = cv::getRotationMatrix2D(
      {0.5F * static_cast<float>(image.cols), 0.5F * static_cast<float>(image.rows)}, degrees, zoom);
  return warped(image, cv::Matx23d(motion.ptr<double>()));
}

cv::Mat noiseLike(const cv::Mat& image, int seed)
{
  cv::Mat noise(image.size(), image.type());
  cv::RNG random(static_cast<std::uint64_t>(seed));
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  return noise;
}

cv::Mat blurred(const cv::Mat& image, double sigma)
{
  cv::Mat result;
  cv::GaussianBlur(image, result, {0, 0}, sigma);
  return result;
}

/// So many levels about a value of 14 bits, as a thermal camera writes.
cv::Mat thermal(const cv::Mat& image, double levels)
{
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  cv::Mat result;
  grey.convertTo(result, CV_16U, levels / 255.0, 7300.0);
  return result;
}

Spoil otherScene(const std::vector<std::size_t>& views)
{
  return [=](LightField& field)
  {
    static const LightField other = renderRightScene(77).light_field;
    for (const std::size_t view : views)
    {
      field.views[view].image = other.views[view].image;
    }
  };
}

const std::size_t CENTRE = at(2, 2);

std::vector<MisSetCase> ordersThatAreWrong()
{
  return {
      {"transposed", relabel({false, false, true})},
      {"rows run backwards", relabel({true, false, false})},
      {"columns run backwards", relabel({false, true, false})},
      {"transposed, rows backwards", relabel({true, false, true})},
      {"near is far", relabel({true, true, false})},
      {"transposed, near is far", relabel({true, true, true})},
      {"shuffled", reorder([](std::size_t i) { return (7 * i + 3) % 25; })},
      {"opposite corners swapped", exchange(at(0, 0), at(4, 4))},
      {"neighbours in the middle row swapped", exchange(at(2, 3), at(2, 4))},
      {"neighbours in the middle column swapped", exchange(at(0, 2), at(1, 2))},
      {"neighbours in the first row swapped", exchange(at(0, 1), at(0, 2))},
      {"reference swapped with its neighbour", exchange(CENTRE, at(2, 3))},
      {"ends of the middle row swapped", exchange(at(2, 0), at(2, 4))},
      {"ends of the middle column swapped", exchange(at(0, 2), at(4, 2))},
      {"reference swapped with a corner", exchange(CENTRE, at(0, 0))},
      {"two rows swapped",
       reorder([](std::size_t i) { return i / 5 == 0   ? i + 20
                                          : i / 5 == 4 ? i - 20
                                                       : i; })},
      {"two columns swapped",
       reorder([](std::size_t i) { return i % 5 == 0   ? i + 4
                                          : i % 5 == 4 ? i - 4
                                                       : i; })},
      {"counted from the second view on", reorder([](std::size_t i) { return (i + 2) % 25; })},
      {"in serpentines", reorder([](std::size_t i) { return i / 5 % 2 == 0 ? i : 5 * (i / 5) + 4 - i % 5; })},
      {"another row length", reorder([](std::size_t i) { return (i / 5 * 6 + i % 5) % 25; })},
  };
}

std::vector<MisSetCase> viewsThatAreWrong()
{
  const auto one = [](const std::function<cv::Mat(const cv::Mat&)>& how) { return change({at(2, 0)}, how); };
  return {
      {"a view of another scene", otherScene({at(2, 4)})},
      {"the reference of another scene", otherScene({CENTRE})},
      {"a column of another scene", otherScene({at(0, 4), at(1, 4), at(2, 4), at(3, 4), at(4, 4)})},
      {"a constant view",
       one([](const cv::Mat& i) { return cv::Mat(i.size(), i.type(), cv::Scalar(9, 90, 9)); })},
      {"a black view", one([](const cv::Mat& i) { return cv::Mat(i.size(), i.type(), cv::Scalar()); })},
      {"a view of noise", one([](const cv::Mat& i) { return noiseLike(i, 5); })},
      {"a view twice", [](LightField& f) { f.views[at(2, 0)].image = f.views[at(2, 1)].image.clone(); }},
      {"a view upside down", one(
                                 [](const cv::Mat& i)
                                 {
                                   cv::Mat r;
                                   cv::rotate(i, r, cv::ROTATE_180);
                                   return r;
                                 })},
      {"a view mirrored", one(
                              [](const cv::Mat& i)
                              {
                                cv::Mat r;
                                cv::flip(i, r, 1);
                                return r;
                              })},
      {"a view rotated by 90 degrees", one(
                                           [](const cv::Mat& i)
                                           {
                                             cv::Mat r;
                                             cv::rotate(i, r, cv::ROTATE_90_CLOCKWISE);
                                             cv::resize(r, r, i.size());
                                             return r;
                                           })},
      {"a view 2 px too low", one([](const cv::Mat& i) { return moved(i, 0, 2); })},
      {"a view zoomed by 15 %", one([](const cv::Mat& i) { return turned(i, 0, 1.15); })},
      {"a view rolled by 8 degrees", one([](const cv::Mat& i) { return turned(i, 8); })},
      {"a negative", one([](const cv::Mat& i) { return cv::Mat(cv::Scalar::all(255) - i); })},
      {"a view out of focus", one([](const cv::Mat& i) { return blurred(i, 8); })},
  };
}

std::vector<MisSetCase> lightFieldsThatAreWrong()
{
  const Spoil apart = [](LightField& field)
  {
    cv::RNG random(4);
    for (View& view : field.views)
    {
      view.image = moved(view.image, random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0));
    }
  };
  // As much as the narrow images of this light field show of each other.
  const Spoil far_moving = [](LightField& field)
  {
    for (View& view : field.views)
    {
      view.image = moved(view.image, -80.0 * view.steps.x, -80.0 * view.steps.y);
    }
  };
  const Spoil flat = change(
      allViews(), [](const cv::Mat& i) { return cv::Mat(i.size(), i.type(), cv::Scalar(90, 90, 90)); });
  return {
      {"constant", flat},
      {"all views the same",
       [](LightField& f)
       {
         for (View& v : f.views)
         {
           v.image = f.views[CENTRE].image.clone();
         }
       }},
      {"noise",
       [](LightField& f)
       {
         int s = 0;
         for (View& v : f.views)
         {
           v.image = noiseLike(v.image, ++s);
         }
       }},
      {"not rectified, 4 px", apart},
      {"each view rolled another way",
       [](LightField& f)
       {
         int s = 0;
         for (View& v : f.views)
         {
           v.image = turned(v.image, 6.0 * (++s % 3 - 1));
         }
       }},
      {"thermal, 10 levels of 16 bits", change(allViews(), [](const cv::Mat& i) { return thermal(i, 60); })},
      {"four levels", change(allViews(),
                             [](const cv::Mat& i)
                             {
                               cv::Mat r;
                               i.convertTo(r, -1, 4.0 / 255.0, 3);
                               return r;
                             })},
      {"a range that is too small", [](LightField&) {}, DisparityRange{-0.4F, 0.3F}},
      {"a range beside the scene", [](LightField&) {}, DisparityRange{4.0F, 8.0F}},
      {"motion beyond what is searched", far_moving},
  };
}

}  // namespace

SyntheticLightField rightScene(std::uint32_t seed)
{
  return renderRightScene(seed);
}

std::size_t misSetIndex(int row, int column)
{
  return at(row, column);
}

Spoil exchangeViews(std::size_t a, std::size_t b)
{
  return exchange(a, b);
}

Spoil viewsOfOtherScene(const std::vector<std::size_t>& views)
{
  return otherScene(views);
}

std::vector<MisSetCase> misSetCases()
{
  std::vector<MisSetCase> cases;
  for (const auto& group : {ordersThatAreWrong(), viewsThatAreWrong(), lightFieldsThatAreWrong()})
  {
    cases.insert(cases.end(), group.begin(), group.end());
  }
  return cases;
}

}  // namespace light_field_depth::testing
