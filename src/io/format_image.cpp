// All views in one image: tiles, or a table of lenslets (ESLF of the Lytro cameras).

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <regex>

#include "io/dataset_format.h"
#include "io/image_period.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/image_files.h"

namespace light_field_depth
{
namespace
{
/// The views of a plenoptic camera that look past the edge of the lens are dark: views that are less bright
/// than this part of the middle one are left out.
constexpr double MIN_BRIGHTNESS_OVER_MIDDLE = 0.5;

FolderDescription describeParts(const std::filesystem::path& file, const cv::Size& grid, ViewPart::Kind kind)
{
  FolderDescription description;
  description.format = kind == ViewPart::Kind::Tile ? "tiles" : "lenslets";
  description.place_claim = PlaceClaim::TwoNumbers;
  for (int row = 0; row < grid.height; ++row)
  {
    for (int column = 0; column < grid.width; ++column)
    {
      ViewFile view{file, {row, column}, {}};
      view.part = {kind, grid, {row, column}};
      description.views.push_back(view);
    }
  }
  return description;
}

std::string gridText(const cv::Size& grid)
{
  return std::to_string(grid.height) + " x " + std::to_string(grid.width);
}

void leaveOutDarkViews(const cv::Mat& image, FolderDescription& description)
{
  const auto brightness = [&](const ViewFile& view)
  {
    const cv::Scalar mean = cv::mean(extractPart(image, view.part));
    return mean[0] + mean[1] + mean[2];
  };
  std::vector<ViewFile>& views = description.views;
  const cv::Size grid = views.front().part.grid;
  const std::size_t middle = static_cast<std::size_t>(grid.height / 2) * grid.width + grid.width / 2;
  const double least = MIN_BRIGHTNESS_OVER_MIDDLE * brightness(views[middle]);
  const std::size_t all = views.size();
  views.erase(std::remove_if(views.begin(), views.end(),
                             [&](const ViewFile& view) { return brightness(view) < least; }),
              views.end());
  if (views.size() < all)
  {
    description.notes.push_back(std::to_string(all - views.size()) +
                                " views are left out: less than half as bright as the middle one.");
  }
}

/// COLUMNS x ROWS of a quilt for light field displays, whose name ends in _qs8x6a0.75; nothing otherwise.
std::optional<cv::Size> quiltOf(const std::filesystem::path& file)
{
  static const std::regex form(R"(.*_qs(\d{1,2})x(\d{1,2})(?:a\d*\.?\d*)?)");
  const std::string stem = file.stem().string();
  std::smatch match;
  if (!std::regex_match(stem, match, form))
  {
    return std::nullopt;
  }
  const cv::Size tiles(std::stoi(match[1]), std::stoi(match[2]));
  return tiles.area() > 1 ? std::make_optional(tiles) : std::nullopt;
}

/// The tiles of a quilt are one row of views: they begin at the bottom, on the left.
FolderDescription describeQuilt(const std::filesystem::path& file, const cv::Size& tiles)
{
  FolderDescription description = describeParts(file, tiles, ViewPart::Kind::Tile);
  description.format = "quilt";
  for (ViewFile& view : description.views)
  {
    view.number = {0, (tiles.height - 1 - view.part.cell.row) * tiles.width + view.part.cell.column};
  }
  description.notes.push_back("'" + file.filename().string() + "' is read as a quilt of " +
                              std::to_string(tiles.area()) +
                              " views in a row, as its name says; --tiles ROWSxCOLUMNS reads it as a grid.");
  return description;
}

/// Whether the name says that it is a table of lenslets: flower_eslf.png.
bool isNamedEslf(const std::filesystem::path& file)
{
  std::string stem = file.stem().string();
  std::transform(stem.begin(), stem.end(), stem.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return stem.find("eslf") != std::string::npos;
}

/// Those of the Lytro cameras, by the size of the image alone; nothing if neither divides it.
std::optional<cv::Size> lensletsOfSize(const cv::Size& size)
{
  for (const int side : {14, 15})
  {
    if (size.width % side == 0 && size.height % side == 0)
    {
      return cv::Size(side, side);
    }
  }
  return std::nullopt;
}

Recognition recognizeParts(const std::filesystem::path& file, const DatasetOptions& options)
{
  const cv::Mat image = readImage(file, nullptr, options.max_megapixels);
  if (options.tiles)
  {
    if (image.cols % options.tiles->width != 0 || image.rows % options.tiles->height != 0)
    {
      throw InputError("The image '" + file.string() + "' of " + std::to_string(image.cols) + " x " +
                       std::to_string(image.rows) + " pixels cannot be cut into " + gridText(*options.tiles) +
                       " equal tiles; check --tiles.");
    }
    return describeParts(file, *options.tiles, ViewPart::Kind::Tile);
  }
  const auto quilt = quiltOf(file);
  if (quilt && image.cols % quilt->width == 0 && image.rows % quilt->height == 0)
  {
    return describeQuilt(file, *quilt);
  }
  auto lenslets = findLenslets(image);
  if (!lenslets && isNamedEslf(file))
  {
    lenslets = lensletsOfSize(image.size());
  }
  if (lenslets)
  {
    FolderDescription description = describeParts(file, *lenslets, ViewPart::Kind::Lenslet);
    description.notes.push_back("'" + file.filename().string() + "' is read as lenslets of " +
                                gridText(*lenslets) + " pixels; --tiles ROWSxCOLUMNS reads it as tiles.");
    leaveOutDarkViews(image, description);
    return description;
  }
  if (const auto tiles = findTiles(image))
  {
    FolderDescription description = describeParts(file, *tiles, ViewPart::Kind::Tile);
    description.notes.push_back("'" + file.filename().string() + "' is read as " + gridText(*tiles) +
                                " tiles; --tiles ROWSxCOLUMNS says otherwise.");
    return description;
  }
  return Recognition::no("'" + file.filename().string() + "' shows neither lenslets nor tiles that repeat");
}

}  // namespace

FolderDescription describeImage(const std::filesystem::path& file, const DatasetOptions& options)
{
  Recognition recognition = recognizeParts(file, options);
  if (!recognition)
  {
    throw InputError("'" + file.string() + "' is one image, and " + recognition.reason() +
                     "; if its views are tiles, say how many with --tiles ROWSxCOLUMNS, otherwise name the "
                     "folder that holds the views.");
  }
  return std::move(*recognition);
}

Recognition recognizeImage(const FolderListing& listing, const DatasetOptions& options)
{
  if (listing.images.size() != 1)
  {
    return Recognition::no("there are " + std::to_string(listing.images.size()) + " images, not one");
  }
  return recognizeParts(listing.images.front(), options);
}

}  // namespace light_field_depth
