/* SPDX-License-Identifier: MIT */
/* junit.c - writes the elements of JUnit XML that enclose the test cases. */
#include "junit.h"

/* Write an XML attribute: a space, then NAME="VALUE". */
static void write_attribute(FILE *out, const char *name, const char *value)
{
    fprintf(out, " %s=\"", name);
    write_escaped(out, value, escape_xml_character);
    putc('"', out);
}

/* All test cases are in one suite, so the root element and the suite element have the same counts. */
void junit_begin(FILE *out, const char *tool, const char *path, size_t tests, size_t failures, size_t errors)
{
    static const char counts[] = " tests=\"%zu\" failures=\"%zu\" errors=\"%zu\" skipped=\"0\" time=\"0\">\n";
    fprintf(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"%s\"", tool);
    fprintf(out, counts, tests, failures, errors);
    fputs("  <testsuite", out);
    write_attribute(out, "name", path);
    fprintf(out, counts, tests, failures, errors);
}

void junit_end(FILE *out)
{
    fputs("  </testsuite>\n</testsuites>\n", out);
}

void junit_begin_case(FILE *out, const char *path, const char *name)
{
    fputs("    <testcase", out);
    write_attribute(out, "classname", path);
    write_attribute(out, "name", name);
    fputs(" time=\"0\"", out);
}
