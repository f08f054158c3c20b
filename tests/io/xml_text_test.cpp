#include "io/xml_text.h"

#include <gtest/gtest.h>

#include "unsnarl/depth_limit.h"
#include "unsnarl/document.h"

namespace unsnarl {
namespace {

const std::string text =
    "\xEF\xBB\xBF<?xml version='1.0'?>\n<!DOCTYPE a [<!ENTITY x \"grown\">]>\n<a n=\"12\" m='&x;' e=\"\">\r\n"
    "  <b> one &lt; &x; </b>\n  <c><![CDATA[two]]><d/></c> <e/> <f>x<d/>y</f>\n</a>\n";

std::string part(const ByteRange& range) {
  return text.substr(range.begin, range.size);
}
std::string error(const std::string& xml, const char* root = "a") {
  try {
    XmlText(xml, root);
  } catch (const FileError& refusal) {
    return refusal.what();
  }
  return {};
}

TEST(XmlText, tells_where_everything_is) {
  const XmlText xml(text, "a");
  EXPECT_EQ(part(xml.range(xml.root().attribute("n"))), "12");
  EXPECT_EQ(part(xml.range(xml.root().attribute("m"))), "&x;");
  EXPECT_EQ(part(xml.range(xml.root().attribute("e"))), "");
  EXPECT_EQ(part(xml.content(xml.root().child("b"))), " one &lt; &x; ");
  EXPECT_EQ(part(xml.content(xml.root().child("c"))), "two");
  EXPECT_EQ(part(xml.content(xml.root().child("e"))), "");
  EXPECT_EQ(text.substr(xml.begin(xml.root().child("c")), 2), "c>");
  EXPECT_THROW(static_cast<void>(xml.content(xml.root().child("f"))), FileError);
}

TEST(XmlText, reads_whole_numbers) {
  const XmlText xml(text, "a");
  EXPECT_EQ(xml.whole_number(xml.root(), "n", 7), 12u);
  EXPECT_EQ(xml.whole_number(xml.root(), "none", 7), 7u);
  EXPECT_THROW(static_cast<void>(xml.whole_number(xml.root(), "m", 7)), FileError);
  EXPECT_THROW(static_cast<void>(xml.whole_number(xml.root(), "e", 7)), FileError);
}

TEST(XmlText, reads_a_beginning_that_is_closed_for_it) {
  const std::string beginning = "<a><b>1</b><c>";
  const XmlText xml(beginning, "a", "</c></a>");
  EXPECT_EQ(xml.content(xml.root().child("b")).begin, 6u);
}

TEST(XmlText, errors_name_the_line) {
  EXPECT_EQ(error("").substr(0, 17), "the file is empty");
  EXPECT_EQ(error("<a>\n\n<b></a>").substr(0, 7), "line 3:");
  EXPECT_EQ(error("\n<b/>"), "line 2: the root element is <b>, but <a> should be here; check the format");
  EXPECT_NE(error(std::string("<\0a\0/>", 6)), "");
  EXPECT_NE(error(std::string("\xFF\xFE<\0a\0/\0>\0", 10)), "");
}

std::string nested(std::size_t depth, const std::string& inside = {}) {
  std::string xml;
  for (std::size_t i = 0; i < depth; ++i) xml += "<a>";
  xml += inside;
  for (std::size_t i = 0; i < depth; ++i) xml += "</a>";
  return xml;
}

TEST(XmlText, what_is_nested_too_deeply_is_refused) {
  EXPECT_EQ(error(nested(deepest_nesting, "text<!-- and a comment -->")), "");
  EXPECT_EQ(error(nested(deepest_nesting + 1)).substr(0, 26), "line 1: nested too deeply:");
  EXPECT_EQ(error(nested(200000)).substr(0, 26), "line 1: nested too deeply:");
  EXPECT_NE(error(nested(200000).substr(0, 600000)), "");
}

}  // namespace
}  // namespace unsnarl
