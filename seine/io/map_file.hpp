#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "seine/geom/grid.hpp"
#include "seine/io/image.hpp"
#include "seine/io/reading.hpp"

namespace seine::io {

/// A ROS map_server map (`*.yaml` beside a PGM or PNG picture), or a MovingAI grid (`*.map`, one metre a
/// cell, lower-left corner at the origin). Occupied and unknown cells are obstacles. Throws InputError.
/// @param reading gets the files that are read, where it is given
geom::OccupancyGrid load_map(const std::filesystem::path& path, Reading* reading = nullptr);

/// What a map_server YAML file says.
struct MapHeader {
  std::string image;             ///< path of the picture, relative to the file
  int image_line = 0;            ///< where the file names it, 1-based
  double resolution = 0.05;      ///< m per pixel
  geom::Pose2 origin;            ///< pose of the lower-left corner of the lower-left pixel
  bool negate = false;           ///< white is occupied
  double occupied_above = 0.65;  ///< probability of being occupied
  double free_below = 0.196;
};
/// @param file name for messages
MapHeader parse_map_header(std::string_view text, const std::string& file);

/// Cells are free where the picture says so with p < free_below; row 0 of the picture is the top of the grid.
geom::OccupancyGrid grid_from_image(const GreyImage& image, const MapHeader& header);

/// A MovingAI grid [Sturtevant12]: `.`, `G` and `S` are free.
geom::OccupancyGrid parse_movingai(std::string_view text, const std::string& file);

/// Writes `path` (YAML) and a PGM with the same stem beside it; load_map gives back an equal grid.
void save_map(const geom::OccupancyGrid& grid, const std::filesystem::path& path);

}  // namespace seine::io
