#include "flights/report/flight_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "study/report/markup.h"

namespace grid_path_planner::flights {

using Eigen::Vector2d;

namespace {

constexpr double kAroundEnd = 8.0;  // m
constexpr double kMargin = 2.0;     // m

double cross(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// Andrew's monotone chain.
Outline convexHull(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  Outline hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = hull.size();
    for (const Vector2d& point : points) {
      while (hull.size() >= begin + 2 && cross(hull[hull.size() - 2], hull.back(), point) <= 0.0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

// Metres in the picture, y downwards.
std::string pointText(double x, double y) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f,%.2f ", x, -y);
  return text;
}

struct Window {
  Vector2d low, high;
  bool meets(const Outline& outline) const {
    Vector2d least = outline.front(), most = outline.front();
    for (const Vector2d& corner : outline) {
      least = least.cwiseMin(corner);
      most = most.cwiseMax(corner);
    }
    return (most - low).minCoeff() > 0.0 && (high - least).minCoeff() > 0.0;
  }
};

std::string outlinesSvg(const std::vector<Outline>& outlines, const Window& window) {
  std::string path;
  for (const Outline& outline : outlines) {
    if (!window.meets(outline)) continue;
    path += "M";
    for (const Vector2d& corner : outline) path += pointText(corner.x(), corner.y());
    path += "Z";
  }
  return "<path fill=\"#8a8f94\" d=\"" + path + "\"/>";
}

std::string pathSvg(const FlightRecord& flight, const Window& window, double width) {
  std::string points;
  for (const Eigen::Vector3f& place : flight.path)
    if (place.x() > window.low.x() && place.x() < window.high.x() && place.y() > window.low.y() &&
        place.y() < window.high.y())
      points += pointText(place.x(), place.y());
  char style[96];
  std::snprintf(style, sizeof style, "fill=\"none\" stroke-width=\"%.2f\" stroke-opacity=\"0.6\"",
                width);
  return std::string("<polyline ") + style + " stroke=\"" +
         (flight.success() ? "#0072B2" : "#D55E00") + "\" points=\"" + points + "\"/>";
}

std::string crossSvg(const FlightRecord& flight, double size, const std::string& title) {
  char text[256];
  const double x = flight.at.x(), y = -flight.at.y();
  std::snprintf(text, sizeof text,
                "<path stroke=\"#D55E00\" stroke-width=\"%.2f\" "
                "d=\"M%.2f %.2fl%.2f %.2fm0 %.2fl%.2f %.2f\">",
                0.25 * size, x - size, y - size, 2 * size, 2 * size, -2 * size, -2 * size,
                2 * size);
  return text + ("<title>" + study::escaped(title) + "</title></path>");
}

std::string waypointsSvg(const FlightStudy& study, const Window& window) {
  std::string svg;
  for (const auto& place : study.route) {
    if ((place.head<2>() - window.low).minCoeff() < 0.0 ||
        (window.high - place.head<2>()).minCoeff() < 0.0)
      continue;
    char text[160];
    std::snprintf(text, sizeof text,
                  "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"1\" fill=\"none\" stroke=\"#009E73\" "
                  "stroke-width=\"0.15\"/>",
                  place.x(), -place.y());
    svg += text;
  }
  return svg;
}

std::string pictureFrame(const Window& window, const std::string& title, const std::string& body) {
  char box[160];
  std::snprintf(box, sizeof box, "<svg viewBox=\"%.1f %.1f %.1f %.1f\" role=\"img\" aria-label=\"",
                window.low.x(), -window.high.y(), window.high.x() - window.low.x(),
                window.high.y() - window.low.y());
  return box + study::escaped(title) + "\"><title>" + study::escaped(title) + "</title>" + body +
         "</svg>";
}

std::string causeOf(const FlightRecord& flight) {
  return std::string(base::choiceName(flight.end)) + ": " + flight.sentence;
}

}  // namespace

std::vector<Outline> outlinesOf(const simulation::World& world, double low, double high) {
  std::vector<Outline> outlines;
  for (const simulation::TriangleMesh& mesh : world.solid()) {
    const Eigen::AlignedBox3f bounds = mesh.bounds();
    if (bounds.max().z() < low || bounds.min().z() > high) continue;
    std::vector<Vector2d> points;
    for (const Eigen::Vector3f& vertex : mesh.vertices)
      points.push_back(vertex.head<2>().cast<double>());
    const Outline hull = convexHull(points);
    if (hull.size() >= 3) outlines.push_back(hull);
  }
  return outlines;
}

std::string flightsPicture(const FlightStudy& study, const std::vector<Outline>& outlines,
                           const std::vector<const FlightRecord*>& flights,
                           const std::string& title) {
  Window window{study.start.head<2>(), study.start.head<2>()};
  const auto include = [&window](const Vector2d& place) {
    window.low = window.low.cwiseMin(place);
    window.high = window.high.cwiseMax(place);
  };
  for (const auto& place : study.route) include(place.head<2>());
  for (const FlightRecord* flight : flights)
    for (const Eigen::Vector3f& place : flight->path) include(place.head<2>().cast<double>());
  window.low.array() -= kMargin;
  window.high.array() += kMargin;
  std::string body = outlinesSvg(outlines, window) + waypointsSvg(study, window);
  for (const FlightRecord* flight : flights) body += pathSvg(*flight, window, 0.12);
  for (const FlightRecord* flight : flights)
    if (!flight->success()) body += crossSvg(*flight, 0.5, causeOf(*flight));
  return pictureFrame(window, title, body);
}

std::string endPicture(const FlightStudy& study, const std::vector<Outline>& outlines,
                       const FlightRecord& flight, const std::string& title) {
  const Vector2d at = flight.at.head<2>();
  const Window window{at.array() - kAroundEnd, at.array() + kAroundEnd};
  return pictureFrame(window, title,
                      outlinesSvg(outlines, window) + waypointsSvg(study, window) +
                          pathSvg(flight, window, 0.08) + crossSvg(flight, 0.2, causeOf(flight)));
}

std::string standalonePicture(const std::string& svg) {
  const std::string tag = "<svg ";
  return tag + "xmlns=\"http://www.w3.org/2000/svg\" width=\"1000\" style=\"background:#fff\" " +
         svg.substr(tag.size()) + '\n';
}

}  // namespace grid_path_planner::flights
