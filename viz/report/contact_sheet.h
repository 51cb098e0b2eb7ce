/* SPDX-License-Identifier: MIT */
/* contact_sheet.h - writes contact.png into the folder of evidence: one picture with a row for each of the first
 * groups, which shows the expected picture, the actual picture and the difference, reduced. */
#ifndef REPORT_CONTACT_SHEET_H
#define REPORT_CONTACT_SHEET_H

#include "report.h"

#define CONTACT_SHEET "contact.png"
#define CONTACT_SHEET_ROWS 16

/* Write contact.png, unless no frame differs. The pictures of evidence must exist; at most one of them is in memory. */
bool contact_sheet_write(const diff_report *report, octreel_error *error);

#endif
