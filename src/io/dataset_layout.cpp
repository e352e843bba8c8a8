#include "io/dataset_layout.h"

#include <algorithm>
#include <cmath>

#include "io/view_placement.h"
#include "light_field_depth/core/depth_sign.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/core/index_grid.h"
#include "light_field_depth/core/view_layout.h"

namespace light_field_depth
{
namespace
{
std::string gridText(const cv::Size& grid)
{
  return std::to_string(grid.height) + " x " + std::to_string(grid.width);
}

/// A square number is a square; all else is a row until something better is known.
cv::Size guessedGrid(int count)
{
  const int side = static_cast<int>(std::lround(std::sqrt(count)));
  return side * side == count ? cv::Size(side, side) : cv::Size(count, 1);
}

/// What the images say, against what is claimed.
struct ImageEvidence
{
  Layout claimed;
  Layout layout;
  bool layout_decided = false;
  bool sign_decided = false;
  bool sign_guessed = false;  ///< an axis runs backwards, and nothing tells which
};

Flip toggled(Flip flip, bool rows, bool columns)
{
  const bool has_rows = (flip == Flip::Rows || flip == Flip::Both) != rows;
  const bool has_columns = (flip == Flip::Columns || flip == Flip::Both) != columns;
  if (has_rows)
  {
    return has_columns ? Flip::Both : Flip::Rows;
  }
  return has_columns ? Flip::Columns : Flip::None;
}

/// The views on the row and the column of the reference, decoded; nothing if they are too few, or do not fit
/// together (which is said later).
std::optional<LightField> crossOf(const PlacedViews& placed, const std::vector<ViewFile>& files,
                                  ViewStore& store)
{
  std::vector<View> views;
  std::vector<std::size_t> ids;
  for (std::size_t i = 0; i < placed.views.size(); ++i)
  {
    const View& view = placed.views[i];
    if (view.grid.row == placed.reference.row || view.grid.column == placed.reference.column)
    {
      views.push_back(view);
      ids.push_back(files[i].id);
    }
  }
  store.decode(ids);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    views[i].image = store.image(ids[i]);
    if (views[i].image.size() != views.front().image.size() ||
        views[i].image.type() != views.front().image.type())
    {
      return std::nullopt;
    }
  }
  constexpr int MIN_SIDE_PX = 16;
  const cv::Size size = views.empty() ? cv::Size() : views.front().image.size();
  if (views.size() < 2 || std::min(size.width, size.height) < MIN_SIDE_PX)
  {
    return std::nullopt;
  }
  return makeLightField(std::move(views), placed.reference);
}

/// Disparities that are all on one side of zero are those of parallel cameras, which have no negative ones.
bool isBehindTheCamera(const DepthSign& sign)
{
  constexpr float MAX_SPREAD_SHARE = 2.0F;
  return sign.range.max < 0.0F && sign.range.max - sign.range.min < -MAX_SPREAD_SHARE * sign.range.max;
}

std::optional<ImageEvidence> lookAtImages(const FolderDescription& description, const Layout& claimed,
                                          ViewStore& store)
{
  FolderDescription copy = description;
  const PlacedViews placed =
      placeViews(description.views.front().path.parent_path(), copy, claimed, std::nullopt);
  const std::optional<LightField> cross = crossOf(placed, copy.views, store);
  if (!cross)
  {
    return std::nullopt;
  }
  const FoundLayout found = findLayout(*cross, store.pool());
  ImageEvidence evidence;
  evidence.claimed = {claimed.order, placed.flip};
  evidence.layout = evidence.claimed;
  evidence.layout_decided = found.decided;
  GridSymmetry symmetry;
  if (found.decided)
  {
    symmetry.transposed = found.layout.transposed;
    // Reversed columns are what is turned round first; they are rows before they are transposed.
    (symmetry.transposed ? symmetry.rows_reversed : symmetry.columns_reversed) = found.layout.mirrored;
    Flip flip = placed.flip;
    if (symmetry.transposed)
    {
      evidence.layout.order = claimed.order == Order::RowMajor ? Order::ColumnMajor : Order::RowMajor;
      flip = flip == Flip::Rows ? Flip::Columns : flip == Flip::Columns ? Flip::Rows : flip;
    }
    evidence.layout.flip = toggled(flip, false, found.layout.mirrored);
  }
  const DepthSign sign = findDepthSign(relabelled(*cross, symmetry), store.pool());
  const bool backwards = found.decided && found.layout.mirrored && !sign.decided && isBehindTheCamera(sign);
  evidence.sign_decided = sign.decided;
  evidence.sign_guessed = found.decided && found.layout.mirrored && !sign.decided && !backwards;
  if (sign.reversed || backwards)
  {
    evidence.layout.flip = toggled(*evidence.layout.flip, true, true);
  }
  return evidence;
}

std::string layoutText(const Layout& layout)
{
  return "--order " + toString(layout.order) + " --flip " + toString(*layout.flip);
}

std::string contradictionText(const ImageEvidence& evidence, const DatasetOptions& options)
{
  const bool by_option = options.order || options.flip;
  return std::string("The views are read as ") + layoutText(evidence.claimed) + ", as " +
         (by_option ? "the options say" : "the dataset's description or camera positions say") +
         ", but the images fit " + layoutText(evidence.layout) + "; " +
         (by_option ? "leave these options out" : "give these options") + " if the result looks wrong.";
}

/// The grid that the images tell, or a guess. Says which it is.
cv::Size foundGrid(FolderDescription& description, int count, ViewStore& store)
{
  constexpr int MIN_VIEWS_OF_GRID = 4;
  if (count < MIN_VIEWS_OF_GRID)
  {
    return guessedGrid(count);  // a row: nothing to choose from
  }
  std::vector<ViewFile> views = description.views;
  std::sort(views.begin(), views.end(),
            [](const ViewFile& a, const ViewFile& b) { return a.number.column < b.number.column; });
  RunLength run;
  const bool complete = static_cast<int>(views.size()) == count;
  if (complete)
  {
    views.resize(static_cast<std::size_t>(thumbnailsForRunLength(count)));
    store.decode(idsOf(views));
    std::vector<cv::Mat> thumbnails;
    for (const ViewFile& view : views)
    {
      thumbnails.push_back(thumbnailOf(store.image(view.id)));
      if (thumbnails.back().size() != thumbnails.front().size())
      {
        return guessedGrid(count);  // what is wrong with the sizes is said later
      }
    }
    run = findRunLength(thumbnails, count);
  }
  const cv::Size grid = run.length > 0 ? cv::Size(run.length, count / run.length) : guessedGrid(count);
  description.notes.push_back("The " + std::to_string(count) + " views are taken for a grid of " +
                              gridText(grid) + " (rows x columns), " +
                              (run.length > 0 ? "as the images tell" : "by their number alone") +
                              "; --grid ROWSxCOLUMNS says otherwise.");
  return grid;
}

}  // namespace

void settleGrid(FolderDescription& description, const DatasetOptions& options, ViewStore& store)
{
  if (description.place_claim != PlaceClaim::SingleNumber)
  {
    return;
  }
  std::vector<ViewFile>& views = description.views;
  const auto by_column = [](const ViewFile& a, const ViewFile& b)
  { return a.number.column < b.number.column; };
  const int first = std::min_element(views.begin(), views.end(), by_column)->number.column;
  const int count = std::max_element(views.begin(), views.end(), by_column)->number.column - first + 1;
  cv::Size grid;
  if (options.grid)
  {
    grid = *options.grid;
  }
  else
  {
    grid = description.grid ? description.grid->size() : foundGrid(description, count, store);
  }
  if (count > grid.area())
  {
    throw InputError("The numbers of the views span " + std::to_string(count) + " places, but a grid of " +
                     gridText(grid) + " has " + std::to_string(grid.area()) +
                     "; --grid ROWSxCOLUMNS says which one it is.");
  }
  for (ViewFile& view : views)
  {
    const int index = view.number.column - first;
    view.number = {index / grid.width, index % grid.width};
  }
  description.grid = cv::Rect({0, 0}, grid);
}

Layout settleLayout(FolderDescription& description, const DatasetOptions& options, ViewStore& store)
{
  Layout layout;
  layout.order = options.order.value_or(description.order.value_or(Order::RowMajor));
  layout.flip = options.flip;
  layout.source = options.order || options.flip                   ? LayoutSource::Option
                  : description.place_claim == PlaceClaim::Stated ? LayoutSource::Description
                                                                  : LayoutSource::Names;
  const std::optional<ImageEvidence> evidence = lookAtImages(description, layout, store);
  if (!evidence)
  {
    return layout;
  }
  const Layout seen = evidence->layout;
  if (!evidence->layout_decided && !evidence->sign_decided)
  {
    return layout;
  }
  if (seen.order == evidence->claimed.order && seen.flip == evidence->claimed.flip)
  {
    layout.source = layout.source == LayoutSource::Names ? LayoutSource::Images : layout.source;
    return layout;
  }
  const bool order_free = !options.order && description.place_claim != PlaceClaim::Stated;
  const bool flip_free = !options.flip && description.place_claim != PlaceClaim::Stated;
  const bool order_differs = seen.order != evidence->claimed.order;
  if ((order_differs && !order_free) || (seen.flip != evidence->claimed.flip && !flip_free))
  {
    description.warnings.push_back(contradictionText(*evidence, options));
    return layout;
  }
  layout = seen;
  layout.source = LayoutSource::Images;
  description.notes.push_back("The images tell the layout: --order " + toString(seen.order) + ", --flip " +
                              toString(*seen.flip) + "." +
                              (evidence->sign_guessed ? " Which of the two axes runs backwards they do not "
                                                        "tell; if near is far, give the other flip."
                                                      : ""));
  return layout;
}

}  // namespace light_field_depth
