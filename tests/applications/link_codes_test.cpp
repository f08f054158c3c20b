#include <fmt/format.h>
#include <gtest/gtest.h>

#include "applications/seifert/link_diagram.h"
#include "unsnarl/document.h"
#include "unsnarl/link.h"

namespace unsnarl {
namespace {

LinkDiagram drawn(const std::string& text) {
  const auto diagram = diagram_of(parse_link(text), Eigen::Matrix3d::Identity());
  if (!diagram) throw std::runtime_error("not drawn: " + text);
  return *diagram;
}

int writhe_of(const LinkDiagram& diagram) {
  int sum = 0;
  for (const LinkDiagram::Crossing& c : diagram.crossings) sum += c.sign;
  return sum;
}

std::string code_refusal(const std::string& text) {
  try {
    parse_link(text);
  } catch (const FileError& e) {
    return e.what();
  }
  return "";
}

struct Codes {
  std::string gauss, signed_gauss, dowker_thistlethwaite, planar;
};

/// Of the diagram of a knot, by their definitions.
Codes codes_of(const LinkDiagram& diagram) {
  const std::vector<LinkDiagram::Pass>& passes = diagram.passes[0];
  const auto n = static_cast<int>(passes.size());
  Codes codes;
  std::vector<int> label(diagram.crossings.size(), 0), under_at(label.size()), over_at(label.size());
  for (int k = 0, next = 1; k < n; ++k) {
    const auto [crossing, over] = passes[k];
    if (label[crossing] == 0) label[crossing] = next++;
    (over ? over_at : under_at)[crossing] = k + 1;
    codes.gauss += fmt::format("{}{}", k == 0 ? "{" : ", ", over ? label[crossing] : -label[crossing]);
    codes.signed_gauss +=
        fmt::format("{}{}{}", over ? "O" : "U", label[crossing], diagram.crossings[crossing].sign > 0 ? "+" : "-");
  }
  codes.gauss += "}";
  for (int k = 0; k < n; k += 2) {
    const auto [crossing, over] = passes[k];
    const int even = over ? under_at[crossing] : over_at[crossing];
    codes.dowker_thistlethwaite += fmt::format("{}{}", k == 0 ? "DT: " : " ", over ? even : -even);
  }
  for (std::size_t c = 0; c < label.size(); ++c) {
    const int u = under_at[c], o = over_at[c];
    const int right = diagram.crossings[c].sign > 0 ? o % n + 1 : o,
              left = diagram.crossings[c].sign > 0 ? o : o % n + 1;
    codes.planar += fmt::format("X[{},{},{},{}] ", u, right, u % n + 1, left);
  }
  return codes;
}

TEST(LinkCodes, every_code_of_a_knot_gives_the_knot_back) {
  for (const KnotEntry& entry : knot_table()) {
    const auto diagram = diagram_of(knot_of_table(entry.name), Eigen::Matrix3d::Identity());
    if (diagram->passes.size() != 1 || diagram->crossings.empty()) continue;
    SCOPED_TRACE(entry.name);
    const Polynomial polynomial = alexander_polynomial(*diagram);
    const Codes codes = codes_of(*diagram);
    for (const std::string& code : {codes.gauss, codes.signed_gauss, codes.dowker_thistlethwaite, codes.planar}) {
      SCOPED_TRACE(code);
      const LinkDiagram again = drawn(code);
      EXPECT_EQ(again.crossings.size(), diagram->crossings.size());
      EXPECT_EQ(alexander_polynomial(again), polynomial);
      // Codes without signs do not tell a diagram from its mirror image.
      if (code == codes.signed_gauss || code == codes.planar)
        EXPECT_EQ(writhe_of(again), writhe_of(*diagram));
      else
        EXPECT_EQ(std::abs(writhe_of(again)), std::abs(writhe_of(*diagram)));
    }
  }
}

TEST(LinkCodes, as_tables_and_programs_write_them) {
  for (const char* right_handed :
       {"{1,1,1}", "BR[2,{1,1,1}]", "{2,{1,1,1}}", "[[1,5,2,4],[3,1,4,6],[5,3,6,2]]", "{{1,5,2,4},{3,1,4,6},{5,3,6,2}}",
        "[(0,4,1,3),(2,0,3,5),(4,2,5,1)]", "DT[4,6,2]", "DT: 4 6 2", "[4, 6, 2]", "DT:[(4,6,2)]", "cacbca", "cabca",
        "DT[bca]", "{-1, 2, -3, 1, -2, 3}", "GaussCode[-1,3,-2,1,-3,2]", "GaussCode[1,2,3,1,2,3]", "O1+U2+O3+U1+O2+U3+",
        "[[[-1,3,-2,1,-3,2]],[1,1,1]]"}) {
    SCOPED_TRACE(right_handed);
    EXPECT_EQ(writhe_of(drawn(right_handed)), 3);
  }
  for (const char* left_handed : {"{-1,-1,-1}", "BR[2,{-1,-1,-1}]", "PD[X[1,4,2,5],X[3,6,4,1],X[5,2,6,3]]",
                                  "O1-U2-O3-U1-O2-U3-", "[[[-1,3,-2,1,-3,2]],[-1,-1,-1]]"}) {
    SCOPED_TRACE(left_handed);
    EXPECT_EQ(writhe_of(drawn(left_handed)), -3);
  }
  for (const char* figure_eight : {"{1,-2,1,-2}", "BR[3,{1,-2,1,-2}]", "[(4,2,5,1),(8,6,1,5),(6,3,7,4),(2,7,3,8)]",
                                   "[4, 6, 8, 2]", "dadbcda", "DT[dabcda]"}) {
    SCOPED_TRACE(figure_eight);
    EXPECT_EQ(to_text(alexander_polynomial(drawn(figure_eight))), "1 - 3t + t^2");
  }
  for (const char* hopf : {"GaussCode[{1,-2},{2,-1}]", "DT[{4},{2}]", "O1U2|O2U1", "[[4,1,3,2],[2,3,1,4]]"}) {
    SCOPED_TRACE(hopf);
    const LinkDiagram diagram = drawn(hopf);
    EXPECT_EQ(diagram.passes.size(), 2U);
    EXPECT_EQ(to_text(alexander_polynomial(diagram)), "-1 + t");
  }
}

TEST(LinkCodes, crossings_that_a_twist_removes_are_drawn) {
  for (const char* unknot : {"X[1,1,2,2]", "X[1,2,2,1]", "[[8,1,1,2],[2,7,3,8],[6,3,7,4],[4,5,5,6]]",
                             "[[6,1,1,2],[2,5,3,6],[4,3,5,4]]", "{1,-1}", "{1,-1,2,-2}", "DT[2]"}) {
    SCOPED_TRACE(unknot);
    EXPECT_EQ(to_text(alexander_polynomial(drawn(unknot))), "1");
  }
  // A trefoil with a kink, and one beside another with a crossing between them that turns one of them over.
  EXPECT_EQ(to_text(alexander_polynomial(drawn("O1U2O3U1O2U3O4U4"))), "1 - t + t^2");
  EXPECT_EQ(to_text(alexander_polynomial(drawn("O7U1O2U3O1U2O3U7O4U5O6U4O5U6"))), "1 - 2t + 3t^2 - 2t^3 + t^4");
}

TEST(LinkCodes, say_what_is_wrong) {
  EXPECT_NE(code_refusal("DT[4,6,4]").find("4 is not one of the even numbers 2 to 6"), std::string::npos);
  EXPECT_NE(code_refusal("GaussCode[1,-2,3]").find("crossing"), std::string::npos);
  EXPECT_NE(code_refusal("GaussCode[1,-2,1,-2]").find("once above and once below"), std::string::npos);
  EXPECT_NE(code_refusal("O1U2U1O2").find("no diagram in the plane has it"), std::string::npos);
  EXPECT_NE(code_refusal("O1U1|O2U2").find("falls into several diagrams"), std::string::npos);
  EXPECT_NE(code_refusal("O1+U1-").find("both signs"), std::string::npos);
  EXPECT_NE(code_refusal("O1+U2O2U1").find("some have none"), std::string::npos);
  EXPECT_NE(code_refusal("O1X2").find("'X2' is not a passage"), std::string::npos);
  EXPECT_NE(code_refusal("cbca").find("Dowker-Thistlethwaite"), std::string::npos);
  EXPECT_NE(code_refusal("[]").find("without numbers"), std::string::npos);
  EXPECT_NE(code_refusal("BR[2,{1,-2}]").find("generator 2 of the braid is -2"), std::string::npos);
  EXPECT_NE(code_refusal("{1,2147483647,-2147483648}").find("a braid of 101 strands"), std::string::npos);
}

}  // namespace
}  // namespace unsnarl
