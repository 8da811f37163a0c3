#include "report/study/text/rate_summary.hpp"

#include <algorithm>
#include <cmath>

namespace pah {
namespace {

std::vector<double> rates_of(const std::vector<RateRow>& rows, const RateCase& of,
                             const std::string& accelerator) {
  std::vector<double> rates;
  for (const RateRow& row : rows)
    if (row.accelerator == accelerator && case_of(row) == of) rates.push_back(row.rays_per_second);
  return rates;
}

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

}  // namespace

std::vector<RateCase> cases_of(const std::vector<RateRow>& rows) {
  std::vector<RateCase> cases;
  for (const RateRow& row : rows)
    if (std::ranges::find(cases, case_of(row)) == cases.end()) cases.push_back(case_of(row));
  return cases;
}

RateSpread spread_of(const std::vector<RateRow>& rows, const RateCase& of,
                     const std::string& accelerator) {
  const std::vector<double> rates = rates_of(rows, of, accelerator);
  if (rates.empty()) return {std::nan(""), std::nan(""), std::nan("")};
  const auto [least, most] = std::ranges::minmax(rates);
  return {median(rates), least, most};
}

double ratio_of(const std::vector<RateRow>& rows, const RateCase& of,
                const std::string& accelerator, const std::string& base) {
  std::vector<double> ratios = rates_of(rows, of, accelerator);
  const std::vector<double> bases = rates_of(rows, of, base);
  if (ratios.size() != bases.size()) return std::nan("");
  for (std::size_t i = 0; i < ratios.size(); ++i) ratios[i] /= bases[i];
  return median(ratios);
}

}  // namespace pah
