#include "io/dataset_layout.h"

#include <algorithm>
#include <cmath>

#include "io/view_placement.h"
#include "light_field_depth/core/depth_sign.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/core/index_grid.h"
#include "light_field_depth/core/pair_order.h"
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
  bool swapped_pair = false;  ///< told by the side on which views match, not by occlusions
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
  constexpr int MIN_SIDE_PX = 16;  // what makeLightField() takes
  const cv::Size size = views.empty() ? cv::Size() : views.front().image.size();
  if (views.size() < 2 || std::min(size.width, size.height) < MIN_SIDE_PX)
  {
    return std::nullopt;
  }
  return makeLightField(std::move(views), placed.reference);
}

/// Disparities that are all on one side of zero are those of parallel cameras, which have no negative ones.
/// Not where they spread much more than the nearest one lies from zero: a focus behind the scene does that.
bool isBehindTheCamera(const DepthSign& sign)
{
  constexpr float MAX_SPREAD_SHARE = 2.0F;
  return sign.range.max < 0.0F && sign.range.max - sign.range.min < -MAX_SPREAD_SHARE * sign.range.max;
}

/// Whether the images are known to be focused on a plane: disparities have both signs then.
bool isSheared(const FolderDescription& description)
{
  return description.camera && (description.camera->focus_distance_m.has_value() ||
                                description.camera->disparity_offset_px.value_or(0.0) != 0.0);
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
  if (!sign.decided && !backwards && !isSheared(description) && findPairOrder(*cross, store.pool()).swapped)
  {
    const bool along_rows = cross->views[0].grid.row == cross->views[1].grid.row;
    evidence.sign_decided = true;
    evidence.swapped_pair = true;
    evidence.layout.flip = toggled(*evidence.layout.flip, !along_rows, along_rows);
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

/// The views of an index, from the first number to the last.
struct IndexedViews
{
  int first = 0;  ///< number
  int count = 0;  ///< of numbers
  std::vector<bool> present;

  explicit IndexedViews(const std::vector<ViewFile>& views)
  {
    const auto by_column = [](const ViewFile& a, const ViewFile& b)
    { return a.number.column < b.number.column; };
    first = std::min_element(views.begin(), views.end(), by_column)->number.column;
    count = std::max_element(views.begin(), views.end(), by_column)->number.column - first + 1;
    present.assign(static_cast<std::size_t>(count), false);
    for (const ViewFile& view : views)
    {
      present[static_cast<std::size_t>(view.number.column - first)] = true;
    }
  }

  bool hasGaps() const { return std::find(present.begin(), present.end(), false) != present.end(); }
};

/// Thumbnails of the first views of an index, empty ones where a view is missing; none at all if views differ
/// in size.
std::vector<cv::Mat> firstThumbnails(const FolderDescription& description, const IndexedViews& indexed,
                                     ViewStore& store)
{
  std::vector<cv::Mat> thumbnails(static_cast<std::size_t>(thumbnailsForRunLength(indexed.count)));
  std::vector<ViewFile> views = description.views;
  const auto place = [&](const ViewFile& view)
  { return static_cast<std::size_t>(view.number.column - indexed.first); };
  views.erase(std::remove_if(views.begin(), views.end(),
                             [&](const ViewFile& view) { return place(view) >= thumbnails.size(); }),
              views.end());
  store.decode(idsOf(views));
  cv::Size size;
  for (const ViewFile& view : views)
  {
    cv::Mat& thumbnail = thumbnails[place(view)];
    thumbnail = thumbnailOf(store.image(view.id));
    size = size.empty() ? thumbnail.size() : size;
    if (thumbnail.size() != size)
    {
      return {};  // what is wrong with the sizes is said later
    }
  }
  return thumbnails;
}

/// How views that one number names lie in rows.
struct IndexedGrid
{
  cv::Size size;
  int first_place = 0;  ///< of the first view, counted along the rows: not 0 if some before it are missing
  bool alternating = false;  ///< every second row is numbered backwards
};

IndexedGrid gridOfRun(const RunLength& run, int count)
{
  const int places = run.first_place + count;
  return {cv::Size(run.length, (places + run.length - 1) / run.length), run.first_place, run.alternating};
}

/// The grid that the images tell, or a guess. Says which it is.
IndexedGrid foundGrid(FolderDescription& description, const IndexedViews& indexed, ViewStore& store)
{
  constexpr int MIN_VIEWS_OF_GRID = 4;  // 2 x 2
  if (indexed.count < MIN_VIEWS_OF_GRID)
  {
    return {guessedGrid(indexed.count)};  // a row: nothing to choose from
  }
  const bool has_gaps = indexed.hasGaps();
  const int most_before = description.first_number;
  RunLength run;
  const std::vector<cv::Mat> thumbnails = firstThumbnails(description, indexed, store);
  if (!thumbnails.empty())
  {
    run = has_gaps ? findRunLengthWithGaps(thumbnails, indexed.count, most_before)
                   : findRunLength(thumbnails, indexed.count);
  }
  IndexedGrid grid = {guessedGrid(indexed.count)};
  if (run.length > 0)
  {
    grid = gridOfRun(run, indexed.count);
  }
  else if (has_gaps)
  {
    const SquareWithoutCorners square = findSquareWithoutCorners(indexed.present, most_before);
    if (square.side > 0)
    {
      grid = {cv::Size(square.side, square.side), square.missing_before};
    }
  }
  description.notes.push_back(
      "The " + std::to_string(description.views.size()) + " views are taken for " +
      (grid.size.height == 1 ? "a single row" : "a grid of " + gridText(grid.size) + " (rows x columns)") +
      (has_gaps ? " with views missing" : "") +
      (grid.alternating ? ", every second row numbered backwards" : "") + ", " +
      (run.length > 0 ? "as the images tell" : "by their numbers alone") +
      "; --grid ROWSxCOLUMNS says otherwise.");
  return grid;
}

/// A grid that is stated, and whether the images show that every second row runs backwards.
IndexedGrid statedGrid(FolderDescription& description, const cv::Size& size, const IndexedViews& indexed,
                       ViewStore& store)
{
  IndexedGrid grid = {size};
  if (indexed.hasGaps())
  {
    const int missing = size.area() - indexed.count;
    const std::vector<cv::Mat> thumbnails = firstThumbnails(description, indexed, store);
    const RunLength run =
        thumbnails.empty()
            ? RunLength()
            : findRunLengthWithGaps(thumbnails, indexed.count, std::min(missing, description.first_number));
    const SquareWithoutCorners square =
        findSquareWithoutCorners(indexed.present, std::min(missing, description.first_number));
    grid.first_place = run.length == size.width    ? run.first_place
                       : square.side == size.width ? square.missing_before
                                                   : 0;
    return grid;
  }
  if (size.width > 1 && size.height > 1 && indexed.count == size.area())
  {
    const std::vector<cv::Mat> thumbnails = firstThumbnails(description, indexed, store);
    const RunLength run = thumbnails.empty() ? RunLength() : findRunLength(thumbnails, indexed.count);
    grid.alternating = run.alternating && run.length == size.width;
    if (grid.alternating)
    {
      description.notes.emplace_back("Every second row is numbered backwards, as the images tell.");
    }
  }
  return grid;
}

}  // namespace

void settleGrid(FolderDescription& description, const DatasetOptions& options, ViewStore& store)
{
  if (description.place_claim != PlaceClaim::SingleNumber)
  {
    return;
  }
  const IndexedViews indexed(description.views);
  const std::optional<cv::Size> stated = options.grid       ? options.grid
                                         : description.grid ? std::make_optional(description.grid->size())
                                                            : std::nullopt;
  const IndexedGrid found =
      stated ? statedGrid(description, *stated, indexed, store) : foundGrid(description, indexed, store);
  const cv::Size grid = found.size;
  if (found.first_place + indexed.count > grid.area())
  {
    throw InputError("The numbers of the views span " + std::to_string(indexed.count) +
                     " places, but a grid of " + gridText(grid) + " has " + std::to_string(grid.area()) +
                     "; --grid ROWSxCOLUMNS says which one it is.");
  }
  for (ViewFile& view : description.views)
  {
    const int index = found.first_place + view.number.column - indexed.first;
    const GridPosition place{index / grid.width, index % grid.width};
    const bool backwards = found.alternating && place.row % 2 == 1;
    view.number = {place.row, backwards ? grid.width - 1 - place.column : place.column};
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
  if (evidence->swapped_pair)
  {
    description.warnings.push_back(
        "The two views are swapped: they match as if all of the scene lay behind infinity, so "
        "they are read with --flip " +
        toString(*seen.flip) + "; rename them, or give --flip none if they are focused on a near plane.");
    return layout;
  }
  description.notes.push_back("The images tell the layout: --order " + toString(seen.order) + ", --flip " +
                              toString(*seen.flip) + "." +
                              (evidence->sign_guessed ? " Which of the two axes runs backwards they do not "
                                                        "tell; if near is far, give the other flip."
                                                      : ""));
  return layout;
}

}  // namespace light_field_depth
