/* SPDX-License-Identifier: MIT */
/* xml.h - writes attributes of XML and HTML; used only in this folder. */
#ifndef REPORT_XML_H
#define REPORT_XML_H

#include "text.h"

static inline void write_attribute(FILE *out, const char *name, const char *value)
{
    fprintf(out, " %s=\"", name);
    write_escaped(out, value, escape_xml);
    putc('"', out);
}

#endif
