// Texts: comparison, concat(), format(), match(), printf() (RISpec 3.2 section 15.5).
#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {

Cases textCases() {
  static const Case kCases[] = {
      {"equal texts", "string a = \"one\"; if (a == \"one\") x = 1;", 1},
      {"texts that differ", "string a = \"one\"; if (a != \"two\") x = 1;", 1},
      {"texts that differ in their case", "string a = \"One\"; if (a == \"one\") x = 1;", 0},
      {"concat", "string a = concat(\"one\", \"two\"); if (a == \"onetwo\") x = 1;", 1},
      {"concat of three", "if (concat(\"a\", \"b\", \"c\") == \"abc\") x = 1;", 1},
      {"a text that grows without end is cut",
       "string a = \"x\"; uniform float i; for (i = 0; i < 40; i += 1) a = concat(a, a); x = 1;",
       1,
       {.message = "makes a text that would be longer than"}},
      {"match of repetitions side by side", "x = match(\"^[a-z]{1,64}_[a-z]{1,64}_[0-9]{1,4}$\", \"wood_oak_3\");", 1},
      {"match of a pattern that repeats too often", "x = match(\"((((a{1,255}){1,255}){1,255}){1,255})\", \"a\");", 0},
      {"match of a repeated group", "x = match(\"^(ab){2,3}[{]$\", \"abab{\");", 1},
      {"concat of a parameter",
       "if (concat(p, \".tx\") == \"wood.tx\") x = 1;",
       1,
       {.parameters = "string p = \"wood\";"}},
      {"concat in a loop",
       "string a = \"\"; uniform float k; for (k = 0; k < 3; k += 1) a = concat(a, \"x\"); if (a == \"xxx\") x = 1;",
       1},
      {"format of a number", "if (format(\"%f\", 1.5) == \"1.500000\") x = 1;", 1},
      {"format of whole numbers", "if (format(\"%d of %d\", 3, 4) == \"3 of 4\") x = 1;", 1},
      {"format of a text", "if (format(\"<%s>\", \"a\") == \"<a>\") x = 1;", 1},
      {"format of a color", "if (format(\"%c\", color (1, 2, 3)) == \"1.000000 2.000000 3.000000\") x = 1;", 1},
      {"format of a grey", "if (format(\"%c\", color 1) == \"1.000000 1.000000 1.000000\") x = 1;", 1},
      {"format of a point", "if (format(\"%p\", point (1, 2, 3)) == \"1.000000 2.000000 3.000000\") x = 1;", 1},
      {"format of a per cent sign", "if (format(\"%%\") == \"%\") x = 1;", 1},
      {"format of a frame's number with zeros", "if (format(\"a.%04d.tif\", 7) == \"a.0007.tif\") x = 1;", 1},
      {"format with a sign before the zeros", "if (format(\"%05d %+d\", -7, 7) == \"-0007 +7\") x = 1;", 1},
      {"format of a whole number near 0", "if (format(\"%d\", -0.5) == \"0\") x = 1;", 1},
      {"format with digits behind the point", "if (format(\"%.2f|%6.1f|\", 1.256, 2.25) == \"1.26|   2.2|\") x = 1;",
       1},
      {"format of a text to the left and to the right",
       "if (format(\"%-4s|%4s|%.2s\", \"a\", \"b\", \"cde\") == \"a   |   b|cd\") x = 1;", 1},
      {"format of a color with few digits", "if (format(\"%.1c\", color (1, .5, 0)) == \"1.0 0.5 0.0\") x = 1;", 1},
      {"format with the letters of C", "if (format(\"%g %.1e\", .25, 1500) == \"0.25 1.5e+03\") x = 1;", 1},
      {"format of a small number", "if (format(\"%.9f\", 1e-9) == \"0.000000001\") x = 1;", 1},
      {"format with a width that a stranger chose", "if (format(\"%999999999d\", 1) != \"\") x = 1;", 1},
      {"format of words behind a percent sign", "if (format(\"100% of %d\", 2) == \"100% of 2\") x = 1;", 1},
      {"format with a length", "if (format(\"%ld %lf\", 2, 0.5) == \"2 0.500000\") x = 1;", 1},
      {"format without a value for a letter", "if (format(\"%d %04d\", 1) == \"1 %04d\") x = 1;", 1},
      {"format of a pattern that ends early", "if (format(\"%0\", 1) == \"%0\") x = 1;", 1},
      {"match of a part", "x = match(\"wo\", \"wood\");", 1},
      {"match of nothing", "x = match(\"xy\", \"wood\");", 0},
      {"match of a pattern", "x = match(\"^w.*d$\", \"wood\") + match(\"o+d\", \"wood\") * 10;", 11},
      {"match of a pattern that must be at the beginning", "x = match(\"^ood\", \"wood\");", 0},
      {"match of a class of letters", "x = match(\"[0-9]+\", \"wood7\");", 1},
      {"a text is chosen", "uniform float k = 2; string a = k > 1 ? \"big\" : \"small\"; if (a == \"big\") x = 1;", 1},
      {"a text in a branch", "string a = \"a\"; uniform float k = 2; if (k > 1) a = \"b\"; if (a == \"b\") x = 1;", 1},
      {"adjacent texts are one", "string a = \"one\" \"two\"; if (a == \"onetwo\") x = 1;", 1},
      {"escapes", "if (concat(\"a\\\"\", \"b\") == \"a\\\"b\") x = 1;", 1},
      {"printf changes nothing", "x = s; printf(\"%f\\n\", s);", [](float i) { return i; }},
      {"a text without a value is empty", "string a; if (a == \"\") x = 1;", 1},
  };
  return kCases;
}

}  // namespace tomales::compiler
