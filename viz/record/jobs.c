/* film_jobs.c - see film_jobs.h. */
#include "jobs.h"
#include "job_link.h"
#include "missing.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#define PATIENCE 50 /* milliseconds between two looks at whether to keep going */

/* ---- A job -------------------------------------------------------------------------------------------------- */

typedef struct job {
    pid_t pid;
    int link; /* in the job its own end, in the process that started it the other */
    const film_options *options;
} job;

/* Until its own caller says so, or the process that started it, which may also have died. */
static bool job_keeps_going(void *context)
{
    const job *self = context;
    const film_options *options = self->options;
    return (!options->keep_going || options->keep_going(options->context)) && !link_stirs(self->link, 0);
}

static bool say_step(void *context, const film_step *step, octreel_error *error)
{
    const job *self = context;
    return link_tell_message(self->link, MESSAGE_STEP, step, step->line, step->size) ||
           error_set(error, "nobody collects the ticks");
}

static void say_ready(const job *self, const take *t)
{
    const renderer_info info = renderer_about(t->picture.renderer);
    job_ready ready = {.view = t->view};
    snprintf(ready.context, sizeof ready.context, "%s", info.context);
    snprintf(ready.vendor, sizeof ready.vendor, "%s", info.vendor);
    snprintf(ready.renderer, sizeof ready.renderer, "%s", info.renderer);
    snprintf(ready.version, sizeof ready.version, "%s", info.version);
    link_tell_message(self->link, MESSAGE_READY, NULL, &ready, sizeof ready);
}

/* All that a job does. Its memory goes with it, and what is buffered is not its own. */
static _Noreturn void do_job(job *self, const octree_session *session, const film_share *share)
{
    take t;
    octreel_error error;
    film_options own = *self->options;
    own.keep_going = job_keeps_going;
    own.context = self;
    setenv("LP_NUM_THREADS", "0", 0); /* the other cores have jobs of their own */
    bool ok = take_open(&t, session, &own, own.resume ? FRAMES_KEEP : FRAMES_DRAW, &error);
    if (ok && share->index == 0)
        say_ready(self, &t);
    if (ok && !link_hear(self->link, &t.session_digest, sizeof t.session_digest))
        _exit(EXIT_SUCCESS);
    ok = ok && film_ticks(&t, share, say_step, self, &error);
    if (!ok)
        link_tell_message(self->link, MESSAGE_ERROR, NULL, &error, sizeof error);
    _exit(ok ? EXIT_SUCCESS : EXIT_FAILURE);
}

/* ---- Those who film together -------------------------------------------------------------------------------- */

typedef struct crew {
    recording *recording;
    job *jobs;
    unsigned wanted, count; /* how many there are to be, and are */
    bool dismissed;         /* nobody is to begin another frame */
    message message;
} crew;

/* In a job, the ends of the others' links: a link ends when nobody has the other end. */
static void close_others(const crew *c)
{
    for (unsigned i = 0; i < c->count; i++)
        close(c->jobs[i].link);
}

static bool start_job(crew *c, octreel_error *error)
{
    int ends[2];
    const film_options *options = c->recording->options;
    film_share share = c->recording->share;
    if (!link_open(ends, error))
        return false;
    const pid_t pid = fork();
    if (pid == 0) {
        close(ends[0]);
        close_others(c);
        share.index = c->count;
        share.count = c->wanted;
        do_job(&(job){0, ends[1], options}, c->recording->session, &share);
    }
    const int reason = errno;
    close(ends[1]);
    if (pid > 0) {
        c->jobs[c->count++] = (job){pid, ends[0], options};
        return true;
    }
    close(ends[0]);
    return error_set(error, "a process cannot be started: %s", strerror(reason));
}

static void dismiss(crew *c)
{
    for (unsigned i = 0; i < c->count && !c->dismissed; i++)
        link_end(c->jobs[i].link);
    c->dismissed = true;
}

/* The next message of a job. Meanwhile the caller may want to stop: then what is in hand is finished. */
static void hear(crew *c, const job *j)
{
    const film_options *options = c->recording->options;
    while (!c->dismissed) {
        if (options->keep_going && !options->keep_going(options->context))
            dismiss(c);
        else if (link_stirs(j->link, PATIENCE))
            break;
    }
    link_hear_message(j->link, &c->message);
}

/* How a job ended before its time. True when it was stopped, as one may. */
static bool explain_end(crew *c, unsigned i, octreel_error *error)
{
    int status = 0;
    pid_t ended;
    while ((ended = waitpid(c->jobs[i].pid, &status, 0)) < 0 && errno == EINTR)
        continue;
    c->jobs[i].pid = 0;
    if (ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS)
        return true;
    if (ended > 0 && WIFSIGNALED(status))
        return error_set(error, "job %u of %u was killed by signal %d (%s)", i + 1, c->count, WTERMSIG(status),
                         strsignal(WTERMSIG(status)));
    return error_set(error, "job %u of %u ended early, with status %d", i + 1, c->count, WEXITSTATUS(status));
}

/* Hear a message of this kind from a job. False when there is another: then *ok tells whether it just was stopped. */
static bool expect(crew *c, unsigned i, message_kind kind, bool *ok, octreel_error *error)
{
    hear(c, &c->jobs[i]);
    if (c->message.kind == kind)
        return true;
    *ok = false;
    if (c->message.kind == MESSAGE_ERROR)
        memcpy(error, c->message.bytes, sizeof *error);
    else
        *ok = explain_end(c, i, error);
    return false;
}

/* Take each tick from the job that films it. */
static bool collect(crew *c, octreel_error *error)
{
    recording *r = c->recording;
    bool ok = true;
    for (uint64_t tick = r->share.first; ok && tick < r->share.last; tick++) {
        if (!expect(c, (unsigned)(tick / r->options->every % c->count), MESSAGE_STEP, &ok, error))
            return ok;
        ok = recording_add(r, &c->message.step, error);
    }
    return ok;
}

static bool begin(crew *c, octreel_error *error)
{
    recording *r = c->recording;
    const job_ready *ready = (const job_ready *)(const void *)c->message.bytes;
    const renderer_info info = {
        .context = ready->context, .vendor = ready->vendor, .renderer = ready->renderer, .version = ready->version};
    if (!recording_begin(r, &ready->view, &info, error))
        return false;
    for (unsigned i = 0; i < c->count && !c->dismissed; i++)
        link_tell(c->jobs[i].link, &r->written.digest,
                  sizeof r->written.digest); /* a job that has died is found by its silence */
    return true;
}

/* Let every job finish what it has in hand, and wait for its end. */
static void end_jobs(crew *c)
{
    dismiss(c);
    for (unsigned i = 0; i < c->count; i++) {
        do
            link_hear_message(c->jobs[i].link, &c->message);
        while (c->message.kind != MESSAGE_NONE);
        close(c->jobs[i].link);
        while (c->jobs[i].pid > 0 && waitpid(c->jobs[i].pid, NULL, 0) < 0 && errno == EINTR)
            continue;
    }
    free(c->message.bytes);
    free(c->jobs);
}

/* What is lost by a job that died. */
static bool name_missing(const recording *r, octreel_error *error)
{
    char text[MISSING_TEXT];
    const octreel_error why = *error;
    const film_share *share = &r->share;
    const uint64_t count = missing_frames(r->options->folder, share->first, share->last, r->options->every, text);
    return count == 0
               ? false
               : error_set(error, "%s; %s %s missing, which --resume films", why.text, text, count > 1 ? "are" : "is");
}

/* While the jobs set up the game and what draws it, what is played is put into words. */
static bool film(crew *c, bool *begun, octreel_error *error)
{
    bool ok;
    while (c->count < c->wanted)
        if (!start_job(c, error))
            return false;
    if (!recording_prepare(c->recording, error))
        return false;
    if (!expect(c, 0, MESSAGE_READY, &ok, error))
        return ok;
    *begun = begin(c, error);
    return *begun && collect(c, error);
}

bool film_by_jobs(recording *r, unsigned jobs, octreel_error *error)
{
    crew c = {.recording = r, .wanted = jobs, .jobs = calloc(jobs, sizeof *c.jobs)};
    bool begun = false;
    bool ok = c.jobs ? film(&c, &begun, error) : error_no_memory(error);
    const bool died = !ok && begun && c.message.kind == MESSAGE_NONE;
    end_jobs(&c);
    ok = begun ? recording_end(r, ok, error) : ok;
    return died ? name_missing(r, error) : ok;
}
