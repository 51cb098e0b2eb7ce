/* SPDX-License-Identifier: MIT */
/* contact_sheet.h - contact.png, in the folder of evidence: what differs on one picture, a row for each of the first
 * groups, with what was expected, what is there, and the difference, small. */
#ifndef REPORT_CONTACT_SHEET_H
#define REPORT_CONTACT_SHEET_H

#include "report.h"

#define CONTACT_SHEET "contact.png"
#define CONTACT_SHEET_ROWS 16

/* Nothing is written where no frame differs. The evidence must have its pictures; of those at most one is in memory. */
bool contact_sheet_write(const diff_report *report, octreel_error *error);

#endif
