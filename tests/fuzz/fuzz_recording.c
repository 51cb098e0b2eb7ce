/* SPDX-License-Identifier: MIT */
/* fuzz_recording.c - libFuzzer entry of whole recordings: the files of a recording are edited, and then the recording
 * is verified, compared with its original, picked from, audited, accepted, resumed and joined. The first byte chooses
 * the recording, the second the command, and the rest are edits (support/edited_files.h). Build with clang
 * -fsanitize=fuzzer,address,undefined. */
#include "accept.h"
#include "audit_print.h"
#include "contact_sheet.h"
#include "baseline.h"
#include "explain.h"
#include "film.h"
#include "folder_files.h"
#include "groups.h"
#include "join.h"
#include "pick.h"
#include "recording_file.h"
#include "report.h"
#include "session_file.h"
#include "support/edited_files.h"
#include "text.h"
#include "verify.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* ---- What is filmed ----------------------------------------------------------------------------------------- */

#define SESSION "{\"octreel\": \"session\", \"version\": 2, "
#define VIEW "{\"octreel\": \"recording\", \"version\": 4, \"theme\": \"night\", "

typedef struct filmed {
    const char *session, *view;
} filmed;

static const filmed films[] = {
    {SESSION
     "\"world\": {\"min\": [-100, -100, -100], \"max\": [100, 100, 100]}, "
     "\"tree\": {\"capacity\": 2, \"depth\": 5, \"full\": \"grow\"}, "
     "\"player\": {\"id\": 0, \"position\": [0, 0, 0], \"step\": 5, \"box_size\": 9, \"sweep\": true}, "
     "\"columns\": [\"class\", \"color\", \"intensity\"], "
     "\"points\": [[10, 0, 0, 1, 2, \"#ff8000\", 0.5], [0, 20, 0, 17], [30, 30, 30, 3], [31, 30, 30, 4], "
     "{\"id\": 40, \"position\": [0, 0, 30], \"velocity\": [0, 0, 1.5]}], \"velocities\": [[17, 0.5, 0, 0]], "
     "\"keys\": \"wdnq\", \"ticks\": 4, \"queries\": [{\"knearest\": 2, \"at\": \"player\"}], "
     "\"shapes\": [{\"box\": {\"min\": [-40, -40, -40], \"max\": [40, 40, 40]}}], "
     "\"foreign_nodes\": [{\"id\": 1, \"box\": {\"min\": [-50, -50, -50], \"max\": [50, 50, 50]}, \"kind\": "
     "\"inner\"}, "
     "{\"id\": 2, \"parent\": 1, \"box\": {\"min\": [0, 0, 0], \"max\": [50, 50, 50]}, \"points\": [1, 3], "
     "\"kind\": \"leaf\", \"mode\": \"float\"}]}\n"
     "{\"tick\": 1, \"edits\": [{\"insert\": {\"id\": 99, \"position\": [5, 5, 5], \"velocity\": [1, 0, 0], \"class\": "
     "6}}, {\"remove\": 17}, {\"move\": {\"id\": 40, \"position\": [0, 0, 0]}}, {\"remove\": 1000}], "
     "\"pairs\": [[4, 3], [40, 1], [1, 40], [17, 1]], "
     "\"queries\": [{\"radius\": 25, \"at\": [0, 0, 0], \"answer\": [1, 99, 3], \"visited\": [1], \"pruned\": [2], "
     "\"hit\": [7]}, {\"range\": {\"min\": [-9, -9, -9], \"max\": [9, 9, 9]}, \"at\": \"player\", \"epsilon\": 0.5, "
     "\"bounds\": \"open\"}, "
     "{\"nearest\": [1, 2, 3], \"skip\": 99, \"answer\": [1], \"mode\": \"float\"}], "
     "\"shapes\": [{\"label\": \"first\", \"at\": [5, 5, 5]}, {\"segment\": [[0, 0, 0], [9, 9, 9]]}, {\"point\": [1, "
     "1, 1]}]}\n"
     "{\"tick\": 2, \"gap\": \"no room\"}\n"
     "{\"tick\": 3, \"foreign_nodes\": []}\n",
     VIEW
     "\"size\": [96, 64], \"camera\": \"orbit\", \"layers\": [\"world\", \"nodes\", \"visited\", "
     "\"points\", \"velocities\", \"radius\", \"knearest\", \"player\", \"box\", \"shapes\", \"wrong\", \"text\"], "
     "\"color_by\": \"depth\", \"color_points\": \"class\", \"labels\": true, \"diagram\": \"beside\", "
     "\"slice\": {\"z\": 5}, \"depths\": [0, 4], \"lod\": 1, \"budget\": 1000, \"aa\": 1, \"every\": 1}"},
    {SESSION "\"tree\": {\"capacity\": 1, \"depth\": 3}, \"points\": [[1, 1, 1], [-1, -1, -1], [500, 500, 500], [500, "
             "500, 500], [5000, 0, 0]], \"keys\": \"ddnaw.\", \"queries\": [{\"nearest\": \"player\", \"answer\": "
             "[2]}]}",
     VIEW "\"size\": [64, 48], \"camera\": \"iso\", \"color_by\": \"depth\", \"lod\": 0, \"budget\": 100, "
          "\"aa\": 1, \"layers\": [\"nodes\", \"points\", \"text\"], \"every\": 0}"},
    {SESSION "\"points\": {\"sample\": \"uniform\", \"count\": 9, \"seed\": 1}, \"velocities\": {\"speed\": 90, "
             "\"seed\": 1}, \"player\": null, \"ticks\": 2}",
     VIEW "\"size\": [48, 48], \"camera\": \"top\", \"color_by\": \"plain\", \"lod\": 0, \"budget\": 100, "
          "\"aa\": 2, \"shade\": \"edl\", \"layers\": [\"world\", \"points\"], \"every\": 2}"},
    {SESSION
     "\"world\": {\"min\": [-9, -9, -9], \"max\": [9, 9, 9]}, \"keys\": \"dd\", \"pairs\": true, "
     "\"player\": {\"position\": [-6, 0, 0], \"step\": 1, \"box_size\": 1, \"sweep\": true}, \"points\": [{\"id\": 1, "
     "\"position\": [-3, 0, 0], \"half\": [1, 2, 3]}, {\"id\": 2, \"position\": [2, 0, 0], \"half\": [4, 0.5, 0], "
     "\"velocity\": [-1, 0.5, 0]}, [5, 5, 5, 3]], \"queries\": [{\"radius\": 4, \"at\": [1, 1, 1], \"answer\": [1, "
     "2]}, "
     "{\"knearest\": 2, \"at\": \"player\"}]}\n"
     "{\"tick\": 1, \"edits\": [{\"insert\": {\"id\": 4, \"position\": [0, 0, 0], \"half\": [20, 0, 1e-310]}}]}\n",
     VIEW "\"size\": [64, 48], \"camera\": \"iso\", \"color_by\": \"depth\", \"lod\": 0, \"budget\": 100, "
          "\"aa\": 1, \"layers\": [\"points\", \"bodies\", \"pairs\", \"box\", \"text\"], \"every\": 1}"},
};

enum { FILMS = sizeof films / sizeof films[0], FOLDER = 64 };

static char home[FOLDER], filmed_as[FILMS][FOLDER + 16], edited[FOLDER + 16], reference[FOLDER + 16],
    evidence_folder[FOLDER + 16], digests[FOLDER + 32];
static edited_files originals[FILMS];
static FILE *nowhere;

static void check(bool holds)
{
    if (!holds)
        abort();
}

static void film(const filmed *what, const char *folder)
{
    film_options options = {.folder = folder, .view = view_make_default()};
    film_summary summary;
    octreel_error error = {""};
    session_file file;
    const bool done = session_parse("session", "", what->session, strlen(what->session), &file, &error) &&
                      recording_parse("view", what->view, strlen(what->view), &options.view, &options.every, &error);
    options.values = &file.values;
    if (!done || !film_session(&file.session, &options, &summary, &error)) {
        fprintf(stderr, "%s\n", error.text);
        abort();
    }
    session_release(&file);
}

/* Write a baseline among the files of the recording, so that the fuzzer edits it with them. */
static void add_baseline(const char *folder)
{
    char path[FOLDER + 48];
    octreel_error error;
    const acceptance_note note = {"2026-11-22", "first"};
    const accept_options options = {.reference = path, .frames = folder, .names = &(frame_list){0}, .note = note};
    snprintf(path, sizeof path, "%s/digests.txt", folder);
    accept_frames(&options, NULL, &error); /* fails for a recording without frames */
}

static void remove_home(void)
{
    remove_folder(home);
}

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc, (void)argv;
    unsetenv("GITHUB_ACTIONS");
    setenv("LP_NUM_THREADS", "0", 1); /* starting threads takes most of the time of opening a renderer */
    snprintf(home, sizeof home, "%s/octreel-fuzz-XXXXXX", access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
    check(mkdtemp(home) && (nowhere = fopen("/dev/null", "w")) && atexit(remove_home) == 0);
    snprintf(edited, sizeof edited, "%s/edited", home);
    snprintf(reference, sizeof reference, "%s/reference", home);
    snprintf(evidence_folder, sizeof evidence_folder, "%s/evidence", home);
    snprintf(digests, sizeof digests, "%s/digests.txt", edited);
    for (int i = 0; i < FILMS; i++) {
        snprintf(filmed_as[i], sizeof filmed_as[i], "%s/film%d", home, i);
        film(&films[i], filmed_as[i]);
        add_baseline(filmed_as[i]);
        edited_files_read(&originals[i], filmed_as[i]);
        remove_folder(filmed_as[i]);
        edited_files_write(&originals[i], filmed_as[i]);
    }
    return 0;
}

/* ---- What is done with it ----------------------------------------------------------------------------------- */

/* Abort if a failure has no error text. Returns `done`. */
static bool told(bool done, const octreel_error *error)
{
    check(done || error->text[0]);
    return done;
}

static void verify(void)
{
    verify_report report;
    octreel_error error = {""};
    if (!told(verify_recording(edited, &(verify_options){.jobs = 1}, &report, &error), &error))
        return;
    verify_print(nowhere, edited, &report, false);
    verify_print(nowhere, edited, &report, true);
}

static void report_all(const diff_side sides[2], const diff_result *result, explanation *why, bool evident)
{
    frame_groups groups = {0};
    evidence shown = {.folder = NULL};
    octreel_error error = {""};
    check(frame_groups_make(&groups, result, why, false, &error));
    diff_report all = {.a = &sides[0], .b = &sides[1], .result = result, .why = why, .lines = 10, .groups = &groups};
    if (evident && told(evidence_prepare(evidence_folder, &sides[0], &sides[1], &error), &error) &&
        told(evidence_write_groups(&shown, evidence_folder, result, &groups, &error), &error)) {
        all.evidence = &shown;
        (void)(told(contact_sheet_write(&all, &error), &error) && told(diff_report_page(&all, &error), &error));
    }
    diff_report_text(nowhere, &all);
    diff_report_json(nowhere, &all);
    diff_report_junit(nowhere, &all);
    diff_report_markdown(nowhere, &all);
    diff_report_github(nowhere, &all);
    evidence_release(&shown);
    frame_groups_release(&groups);
}

static void compare(const char *a, const char *b, bool evident)
{
    diff_side sides[2] = {{0}, {0}};
    diff_result result = {0};
    explanation why = {0};
    octreel_error error = {""};
    const diff_options options = diff_options_default();
    if (told(diff_side_open(&sides[0], a, NULL, &error) && diff_side_open(&sides[1], b, NULL, &error) &&
                 diff_run(&sides[0], &sides[1], &options, &result, &error) &&
                 explain(&sides[0], &sides[1], &result, EXPLAIN_DEFAULT, &why, &error),
             &error))
        report_all(sides, &result, &why, evident);
    explanation_release(&why);
    diff_release(&result);
    diff_side_release(&sides[0]);
    diff_side_release(&sides[1]);
}

static void pick_from(const char *frame, int x, int y)
{
    char path[2 * FOLDER];
    const pick_options options = {.x = x, .y = y, .radius = 8};
    pick found;
    octreel_error error = {""};
    snprintf(path, sizeof path, "%s/%s", edited, frame);
    if (!told(pick_frame(path, &options, &found, &error), &error))
        return;
    pick_print(nowhere, &found, false);
    pick_print(nowhere, &found, true);
    pick_release(&found);
}

static void audit(void)
{
    audit_report report = {0};
    octreel_error error = {""};
    const audit_limits limits = {.by_ratio = true, .ratio = 1.5};
    const audit_verdict verdict = {edited, true, &report};
    if (told(audit_replay(edited, &limits, 0, NULL, &report, &error), &error)) {
        audit_print_text(nowhere, &verdict);
        audit_print_json(nowhere, &verdict);
        audit_print_junit(nowhere, &verdict);
        check(audit_print_page(nowhere, &verdict, "."));
    }
    audit_release(&report);
}

static void accept_into(const char *path, const char *reason, bool variant)
{
    const accept_options options = {.reference = path,
                                    .frames = edited,
                                    .names = &(frame_list){0},
                                    .note = {"2026-11-23", reason},
                                    .variant = variant,
                                    .json = variant};
    octreel_error error = {""};
    told(accept_frames(&options, nowhere, &error), &error);
}

static void resume(bool joined)
{
    film_options options = {.folder = edited, .resume = true};
    film_summary summary;
    session_file file = {0};
    uint64_t digest;
    octreel_error error = {""};
    if (joined) {
        told(join_chunks(&options, &summary, &error), &error);
        return;
    }
    if (told(recording_read(edited, &options.view, &options.every, &error) &&
                 read_session_file(edited, &file, &digest, &error),
             &error)) {
        options.values = &file.values;
        told(film_session(&file.session, &options, &summary, &error), &error);
    }
    session_release(&file);
}

/* Few ticks and pixels: a larger recording only takes longer. */
static bool is_small(const edited_files *files)
{
    enum { MOST_TICKS = 300, MOST_PIXELS = 200 * 200 };
    const edited_file *session = edited_files_find(files, "session.json"),
                      *about = edited_files_find(files, "recording.json");
    session_file file;
    view v;
    uint64_t every;
    octreel_error ignored;
    bool small = true;
    if (session && session_parse("", NULL, (char *)session->bytes, session->size, &file, &ignored)) {
        small = octree_session_length(&file.session) < MOST_TICKS;
        session_release(&file);
    }
    if (about && recording_parse("", (char *)about->bytes, about->size, &v, &every, &ignored))
        small = small && v.width * v.height * v.aa * v.aa <= MOST_PIXELS;
    return small;
}

static void use(const edited_files *files, const char *original, unsigned what)
{
    const char *frame = files->files[what % files->count].name;
    if (what & 1)
        verify();
    if (what & 2)
        compare(original, edited, what & 4);
    if (what & 8)
        compare(edited, digests, false);
    if (what & 16)
        pick_from(frame, (int)(what % 48), 20);
    if (what & 32)
        audit();
    if (what & 64)
        accept_into(what & 4 ? digests : reference, what & 4 ? "again" : NULL, what & 2);
    if (what & 128)
        resume(what & 4);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    edited_files files;
    if (size < 2)
        return 0;
    const int which = data[0] % FILMS;
    edited_files_copy(&files, &originals[which]);
    edited_files_apply(&files, data + 2, size - 2);
    if (is_small(&files)) {
        edited_files_write(&files, edited);
        edited_files_write(&originals[(which + data[0] / FILMS) % FILMS], reference);
        remove_folder(evidence_folder);
        use(&files, filmed_as[which], data[1]);
    }
    edited_files_release(&files);
    return 0;
}
