#include "study/report/report_assets.h"

namespace grid_path_planner::study {

const char* const kReportScript = R"js(
"use strict";
for (const table of document.querySelectorAll("table.sorts")) {
  const heads = [...table.tHead.rows[0].cells];
  heads.forEach((head, column) => head.firstElementChild.addEventListener("click", () => {
    const down = head.getAttribute("aria-sort") === "ascending";
    heads.forEach(other => other.removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const key = row => {
      const cell = row.cells[column];
      return cell.dataset.n === undefined ? cell.textContent : Number(cell.dataset.n);
    };
    const order = (a, b) => typeof a === "number" && typeof b === "number" ? a - b
      : typeof a === "number" ? -1 : typeof b === "number" ? 1 : a.localeCompare(b);
    const rows = [...table.tBodies[0].rows].sort((a, b) => (down ? -1 : 1) * order(key(a), key(b)));
    table.tBodies[0].append(...rows);
  }));
}

const data = JSON.parse(document.getElementById("pictures-data").textContent);
if (data.pictures.length > 0) {
  const svgName = "http://www.w3.org/2000/svg";
  const element = id => document.getElementById(id);
  const map = element("map"), query = element("pick-query"), weights = element("pick-weights");
  const checked = () => data.pictures[Number(document.querySelector("input[name=picture]:checked").value)];
  const shownVariants = () => new Set([...document.querySelectorAll("input[name=variant]:checked")].map(i => Number(i.value)));
  const add = (parent, name, attributes) => {
    const child = document.createElementNS(svgName, name);
    for (const [key, value] of Object.entries(attributes)) child.setAttribute(key, value);
    parent.append(child);
    return child;
  };
  const fill = (select, values) => {
    const before = select.value;
    select.replaceChildren(...values.map(value => new Option(value)));
    if (values.includes(before)) select.value = before;
  };
  const draw = () => {
    const picture = checked();
    fill(weights, [...new Set(picture.units.map(unit => unit.weights))]);
    fill(query, ["all queries", ...new Set(picture.units.map(unit => unit.query))]);
    const units = picture.units.filter(unit => unit.weights === weights.value
      && (query.value === "all queries" || unit.query === query.value));
    map.replaceChildren();
    map.setAttribute("viewBox", `0 0 ${picture.width} ${picture.height}`);
    map.setAttribute("aria-label", `${picture.name}, weights ${weights.value}, ${query.value}`);
    add(map, "image", {href: picture.image, x: 0, y: picture.height - picture.imageHeight,
      width: picture.imageWidth, height: picture.imageHeight, preserveAspectRatio: "none"});
    const shown = shownVariants(), lines = [], unit = picture.width / 366;
    for (const each of units)
      for (const path of each.paths)
        if (shown.has(path.variant) && path.points.length > 0) lines.push(path);
    lines.sort((a, b) => a.variant - b.variant);
    // Paths that coincide: the first lie wide below, the last narrow above.
    for (const path of lines) {
      const variant = data.variants[path.variant];
      add(map, "polyline", {points: path.points.join(" "), fill: "none", stroke: variant.colour,
        "stroke-width": unit * (1 + 4 * (data.variants.length - 1 - path.variant) / data.variants.length),
        "stroke-dasharray": variant.dash.split(" ").map(n => n * unit * 1.5 || "").join(" "),
        "stroke-linejoin": "round"});
    }
    for (const each of units) {
      const points = (each.paths.find(path => path.points.length > 0) || {points: []}).points;
      if (points.length < 2) continue;
      add(map, "circle", {cx: points[0], cy: points[1], r: 4 * unit, fill: "#fff", stroke: "#000", "stroke-width": unit});
      const [x, y] = points.slice(-2);
      add(map, "path", {d: `M${x - 4 * unit} ${y - 4 * unit}h${8 * unit}v${8 * unit}h${-8 * unit}z`, fill: "#ffd400", stroke: "#000", "stroke-width": unit});
    }
    const items = [];
    for (const each of units) {
      if (query.value === "all queries" && !each.note) continue;
      const item = document.createElement("li");
      item.textContent = `${each.query}${each.note ? " — " + each.note : ""}`;
      const list = document.createElement("ul");
      if (query.value !== "all queries")
        for (const path of each.paths.filter(path => shown.has(path.variant))) {
          const line = document.createElement("li"), code = document.createElement("code");
          line.textContent = `${data.variants[path.variant].name}: ${path.text} `;
          code.textContent = path.command;
          if (path.command) line.append(document.createElement("br"), code);
          list.append(line);
        }
      item.append(list);
      items.push(item);
    }
    element("results").replaceChildren(...items);
  };
  for (const input of document.querySelectorAll("#viewer input, #viewer select"))
    input.addEventListener("change", draw);
  draw();
}
)js";

}  // namespace grid_path_planner::study
