/* SPDX-License-Identifier: MIT */
/* contact_sheet.h - writes contact.png, an overview picture, into the folder of evidence. Each row of the picture
 * shows one group of differing frames: reduced copies of the expected picture, the actual picture and the
 * difference. Only the first groups have a row. */
#ifndef REPORT_CONTACT_SHEET_H
#define REPORT_CONTACT_SHEET_H

#include "report.h"

#define CONTACT_SHEET "contact.png"
#define CONTACT_SHEET_ROWS 16

/* Write contact.png. If no frame differs, write nothing. The pictures of evidence must exist before the call. At
 * most one of these pictures is in memory at a time. */
bool contact_sheet_write(const diff_report *report, octreel_error *error);

#endif
