/* SPDX-License-Identifier: MIT */
/* contact_sheet.h - writes contact.png, an overview picture, into the folder of evidence. It has one row for each of
 * the first groups. A row shows reduced copies of the expected picture, the actual picture and the difference. */
#ifndef REPORT_CONTACT_SHEET_H
#define REPORT_CONTACT_SHEET_H

#include "report.h"

#define CONTACT_SHEET "contact.png"
#define CONTACT_SHEET_ROWS 16

/* Write contact.png. If no frame differs, write nothing. The pictures of evidence must have been written. At most
 * one of them is in memory. */
bool contact_sheet_write(const diff_report *report, octreel_error *error);

#endif
