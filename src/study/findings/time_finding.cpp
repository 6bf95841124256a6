#include "study/findings/finding_text.h"
#include "study/findings/findings.h"

namespace grid_path_planner::study {

using base::choiceName, base::Status;

namespace {

// The published time in seconds, 0 where none was.
double publishedTime(const StudyData& data, const ProblemSize& size, std::size_t variant) {
  const auto& published = data.study().published.time_s;
  const auto of_variant = published.find(data.study().variants[variant].label);
  if (of_variant == published.end()) return 0.0;
  const auto time = of_variant->second.find(size.kernel);
  return time == of_variant->second.end() ? 0.0 : time->second;
}

std::string againstBaseline(const StudyData& data, std::size_t variant, const ProblemSize& size) {
  const std::size_t base = data.baselineOf(variant);
  if (variant == base) return "";
  const std::vector<double> ratios = data.ratios(base, variant, &size, medianTime);
  if (ratios.empty()) return "";
  const Interval ratio = meanRatio(ratios);
  const std::string at = sizeText(data, size);
  const std::string& name = data.study().variants[variant].label;
  const std::string& base_name = data.study().variants[base].label;
  if (!differs(ratio))
    return "At " + at + " no difference in time between " + name + " and " + base_name +
           " can be claimed (ratio " + intervalText(ratio) + ").";
  if (ratio.value < 1.0)
    return "At " + at + ' ' + name + " takes " +
           intervalText({1.0 / ratio.value, 1.0 / ratio.high, 1.0 / ratio.low}) +
           " times as long as " + base_name + '.';
  return "At " + at + ' ' + base_name + " takes " + intervalText(ratio) + " times as long as " +
         name + '.';
}

}  // namespace

Finding timeFinding(const StudyData& data) {
  Finding finding;
  finding.question = "How long does planning take?";
  finding.table = {"time",
                   "Planning alone, median of the repeats of each run; of those the median and the "
                   "quartiles. Ratios are geometric means over the queries, paired, with their "
                   "95 % interval, and only within a program: this package's planners, or one "
                   "published program. Published times are of another machine and map.",
                   {"map", "kernel", "rule", "variant", "runs", "median [ms]", "lower quartile",
                    "upper quartile", "published [s]", "against", "that / this"},
                   {}};
  for (const ProblemSize& size : data.sizes())
    for (std::size_t variant = 0; variant < data.study().variants.size(); ++variant) {
      const std::vector<double> times = mediansOf(data, size, variant);
      const auto quantile = [&times](double part) {
        return times.empty() ? TableCell("–") : TableCell(quantileOf(times, part), 3);
      };
      const std::size_t base = data.baselineOf(variant);
      const std::vector<double> ratios = data.ratios(base, variant, &size, medianTime);
      const double published = publishedTime(data, size, variant);
      finding.table.rows.push_back(
          {data.study().maps[size.map].name, TableCell(size.kernel, 3), choiceName(size.rule),
           data.study().variants[variant].label, TableCell(static_cast<double>(times.size()), 3),
           quantile(0.5), quantile(0.25), quantile(0.75),
           published > 0.0 ? TableCell(published, 3) : TableCell("–"),
           variant == base ? TableCell("–") : TableCell(data.study().variants[base].label),
           variant == base || ratios.empty() ? TableCell("–") : intervalCell(meanRatio(ratios))});
      const std::string answer = againstBaseline(data, variant, size);
      if (!answer.empty()) finding.answers.push_back(answer);
    }
  return finding;
}

}  // namespace grid_path_planner::study
