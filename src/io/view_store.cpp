#include "io/view_store.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "io/image_period.h"
#include "io/linear_images.h"
#include "io/planar_rig.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/image_files.h"

namespace light_field_depth
{
ViewStore::ViewStore(std::vector<ViewFile>& views, int threads, double max_megapixels)
    : max_megapixels_(max_megapixels), pool_(threads)
{
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    views[i].id = i;
  }
  views_ = views;
  images_.resize(views.size());
  masks_.resize(views.size());
}

void ViewStore::decode(const std::vector<std::size_t>& ids)
{
  std::vector<std::size_t> wanted;
  std::copy_if(ids.begin(), ids.end(), std::back_inserter(wanted),
               [&](std::size_t id) { return images_[id].empty(); });
  readTables(wanted);
  std::vector<std::string> failures(wanted.size());
  pool_.parallelFor(0, static_cast<int>(wanted.size()), 1,
                    [&](int first, int last)
                    {
                      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                      {
                        try
                        {
                          images_[wanted[i]] = read(views_[wanted[i]], masks_[wanted[i]]);
                        }
                        catch (const InputError& error)
                        {
                          failures[i] = error.what();
                        }
                      }
                    });
  const auto failure =
      std::find_if(failures.begin(), failures.end(), [](const std::string& text) { return !text.empty(); });
  if (failure != failures.end())
  {
    throw InputError(*failure);
  }
  encodeFloats(wanted);
}

void ViewStore::encodeFloats(const std::vector<std::size_t>& ids)
{
  for (const std::size_t id : ids)
  {
    if (images_[id].depth() != CV_32F)
    {
      continue;
    }
    if (!white_)
    {
      // The first view decides for all of them, whichever are decoded first.
      white_ = whiteOf(id == 0 || !images_[0].empty() ? images_[0] : read(views_[0], masks_[0]));
    }
    images_[id] = encodedLinear(images_[id], *white_);
  }
}

void ViewStore::readTables(const std::vector<std::size_t>& wanted)
{
  for (const std::size_t id : wanted)
  {
    const ViewFile& view = views_[id];
    if (view.part.kind == ViewPart::Kind::Whole || tables_.count(view.path) > 0)
    {
      continue;
    }
    const cv::Mat table = readImage(view.path, nullptr, max_megapixels_);
    if (table.cols % view.part.grid.width != 0 || table.rows % view.part.grid.height != 0)
    {
      throw InputError("The image '" + view.path.string() + "' of " + std::to_string(table.cols) + " x " +
                       std::to_string(table.rows) + " pixels does not hold " +
                       std::to_string(view.part.grid.height) + " x " + std::to_string(view.part.grid.width) +
                       " equal views; check tiles or lenslets.");
    }
    tables_[view.path] = table;
  }
}

cv::Mat ViewStore::read(const ViewFile& view, cv::Mat& mask) const
{
  if (view.part.kind != ViewPart::Kind::Whole)
  {
    return extractPart(tables_.at(view.path), view.part);
  }
  cv::Mat image = readImage(view.path, &mask, max_megapixels_);
  if (!view.warp)
  {
    return image;
  }
  mask = warpedMask(mask, *view.warp);
  return warped(image, *view.warp);
}

const cv::Mat& ViewStore::image(std::size_t id)
{
  decode({id});
  return images_[id];
}

std::vector<std::size_t> idsOf(const std::vector<ViewFile>& views)
{
  std::vector<std::size_t> ids;
  ids.reserve(views.size());
  std::transform(views.begin(), views.end(), std::back_inserter(ids),
                 [](const ViewFile& view) { return view.id; });
  return ids;
}

}  // namespace light_field_depth
