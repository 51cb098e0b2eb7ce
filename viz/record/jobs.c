/* SPDX-License-Identifier: MIT */
/* jobs.c - records a session with several processes.
 *
 * The problem: drawing and compressing frames takes most of the time of a recording. Frames do not depend on each
 * other, but each tick depends on the tick before it.
 *
 * The idea: every job plays the whole session, which is cheap. At each frame, a job claims the frame in shared memory,
 * and draws it if no other job was faster. Jobs are processes because GL contexts in threads of one process do not
 * scale. Each job sends the lines of its ticks through a socket. The starter, the process that started the jobs, writes
 * the lines to ticks.jsonl in the order of the ticks: the next tick is always the first message of some socket. The
 * files are therefore the same as those of a single process. After a stop or a failure all ticks up to some tick are
 * complete, and a few later frames exist.
 *
 * Jobs begin to draw while the starter still writes session.json. Each frame contains the digest of session.json, so
 * the starter sends the digest to the jobs as soon as the digest is known. A job ends when its socket closes, so no job
 * outlives the starter. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS, which POSIX has since 2024 */
#include "jobs.h"

#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- Pipes -------------------------------------------------------------------------------------------------- */

/* Write all bytes to a socket. MSG_NOSIGNAL prevents SIGPIPE if the other process has closed its end or died. */
static bool pipe_write(int pipe, const void *bytes, size_t size)
{
    for (const char *at = bytes; size > 0;) {
        const ssize_t written = send(pipe, at, size, MSG_NOSIGNAL);
        if (written < 0 && errno != EINTR)
            return false;
        at += written > 0 ? written : 0;
        size -= written > 0 ? (size_t)written : 0;
    }
    return true;
}

/* Read exactly `size` bytes. Returns false on an error. If the other process has closed its end, returns false with
 * errno 0. */
static bool pipe_read(int pipe, void *bytes, size_t size)
{
    for (char *at = bytes; size > 0;) {
        const ssize_t got = read(pipe, at, size);
        if (got < 0 && errno == EINTR)
            continue;
        /* ECONNRESET: the other process closed its end before it had read all bytes sent to it. */
        if (got == 0 || (got < 0 && errno == ECONNRESET))
            errno = 0;
        if (got <= 0)
            return false;
        at += got;
        size -= (size_t)got;
    }
    return true;
}

/* Wait up to `milliseconds`. Returns true if there are bytes to read or the other end is closed. */
static bool pipe_wait_for_bytes(int pipe, int milliseconds)
{
    struct pollfd asked = {.fd = pipe, .events = POLLIN};
    return poll(&asked, 1, milliseconds) > 0;
}

/* The kind of a message from a job. Each message is followed by bytes, whose meaning depends on the kind. */
typedef enum message_kind {
    MESSAGE_STEP,   /* a tick was filmed; the bytes are its line of ticks.jsonl */
    MESSAGE_FAILED, /* the job failed; the bytes are an octreel_error */
    MESSAGE_ENDED,  /* job 0 filmed its last tick or was stopped; the bytes are its frame_checks */
    MESSAGE_NONE,   /* the job ended without a further message */
} message_kind;

typedef struct message {
    message_kind kind;
    film_step step; /* set if kind is MESSAGE_STEP */
    size_t size;    /* number of bytes that follow the message */
} message;

static bool write_message(int pipe, message m, const void *bytes, size_t size)
{
    m.size = size;
    return pipe_write(pipe, &m, sizeof m) && pipe_write(pipe, bytes, size);
}

/* ---- A job -------------------------------------------------------------------------------------------------- */

typedef struct job {
    pid_t pid;
    int pipe; /* a socket between the starter and the job; each of the two processes holds one end */
    const film_options *options;
    uint64_t session; /* digest of session.json, valid if has_session is true */
    bool has_session;
    /* used by the starter: */
    bool has_message;    /* true: `message` is the job's next message */
    message message;     /* a message of kind MESSAGE_NONE is the job's last message */
    char *bytes;         /* the bytes of the message */
    octreel_error error; /* with MESSAGE_NONE: the reason why the job failed, or "" */
} job;

/* Wait until the starter sends the digest of session.json. If the starter stops the job first, the job's process
 * exits. */
static void wait_for_session_digest(job *self)
{
    if (!self->has_session && !pipe_read(self->pipe, &self->session, sizeof self->session))
        _exit(errno == 0 ? EXIT_SUCCESS : EXIT_FAILURE);
    self->has_session = true;
}

static void receive_session_digest(uint64_t *digest, void *context)
{
    job *self = context;
    wait_for_session_digest(self);
    *digest = self->session;
}

/* Returns false if the job must stop: the caller of the recording or the starter stops it, or the starter has died. */
static bool job_keeps_going(void *context)
{
    const job *self = context;
    return watcher_continues(&self->options->watch) && !(self->has_session && pipe_wait_for_bytes(self->pipe, 0));
}

/* The thread of a job that waits until the starter dies and then ends the job, because nobody needs its current frame.
 * If the starter only stops the job, the starter's end of the socket stays open and the job finishes its frame. */
static void *watch_starter(void *context)
{
    const job *self = context;
    struct pollfd asked = {.fd = self->pipe, .events = 0};
    while (poll(&asked, 1, -1) < 0 && errno == EINTR)
        continue;
    _exit(EXIT_FAILURE);
}

/* Start the thread watch_starter() with all signals blocked. If the thread cannot be started, the job notices the
 * starter's death only after its current frame. */
static void start_watching_starter(job *self)
{
    sigset_t all, before;
    pthread_t thread;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    if (pthread_create(&thread, NULL, watch_starter, self) == 0)
        pthread_detach(thread);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

static bool write_step(void *context, const film_step *step, octreel_error *error)
{
    job *self = context;
    /* Wait for the digest of session.json: the starter reads no messages before it has sent the digest. */
    wait_for_session_digest(self);
    return write_message(self->pipe, (message){.step = *step}, step->line, step->size) ||
           error_set(error, "the process that collects the ticks has ended");
}

/* Run a job in its own process. The process ends with _exit(), because its stdio buffers are copies of the starter's
 * buffers and must not be flushed a second time. */
static _Noreturn void run_job(job *self, const recording *r, playback *p, const film_share *share)
{
    octreel_error error;
    const watcher watch = {.keep_going = job_keeps_going, .context = self};
    /* The software GL (llvmpipe) must not start threads: other jobs use the other cores. */
    setenv("LP_NUM_THREADS", "0", 0);
    draw_context_set_report(NULL); /* the starter reports the GL context, so the job must not */
    start_watching_starter(self);
    /* receive_session_digest() waits for the digest of session.json. The playback calls this function only after its
     * first frame is drawn. */
    p->learn_session = receive_session_digest;
    p->learn_context = self;
    const bool ok = recording_open_picture(r, p, &error) && playback_run(p, share, write_step, self, &watch, &error);
    if (ok && share->index == 0)
        write_message(self->pipe, (message){.kind = MESSAGE_ENDED}, &p->checks, sizeof p->checks);
    else if (!ok)
        write_message(self->pipe, (message){.kind = MESSAGE_FAILED}, &error, sizeof error);
    _exit(ok ? EXIT_SUCCESS : EXIT_FAILURE);
}

/* ---- All jobs ----------------------------------------------------------------------------------------------- */

typedef struct job_pool {
    recording *recording;
    job *jobs;
    unsigned wanted, count; /* number of jobs to start, and number of jobs that are already started */
    bool stopped;           /* true: no job begins another frame */
    atomic_uchar *claims;   /* the claims of the share, in shared memory */
    size_t claim_count;
} job_pool;

static bool start_job(job_pool *pool, playback *p, octreel_error *error)
{
    int ends[2];
    recording *r = pool->recording;
    film_share share = r->share;
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0)
        return error_set(error, "cannot create a socket for a job: %s", strerror(errno));
    const pid_t pid = fork();
    if (pid == 0) {
        close(ends[0]);
        for (unsigned i = 0; i < pool->count; i++)
            /* Close the copies that fork() made: a socket closes only when all copies of its other end are closed. */
            close(pool->jobs[i].pipe);
        share.index = pool->count;
        share.claims = pool->claims;
        run_job(&(job){.pipe = ends[1], .options = r->options}, r, p, &share);
    }
    const int reason = errno;
    close(ends[1]);
    if (pid > 0) {
        pool->jobs[pool->count++] = (job){.pid = pid, .pipe = ends[0], .options = r->options};
        return true;
    }
    close(ends[0]);
    return error_set(error, "cannot start a job: %s", strerror(reason));
}

/* Stop all jobs after their current frames. */
static void stop_jobs(job_pool *pool)
{
    for (unsigned i = 0; i < pool->count && !pool->stopped; i++)
        shutdown(pool->jobs[i].pipe, SHUT_WR);
    pool->stopped = true;
}

/* Wait for the end of a job. The job's socket is closed first: a job that waits for a message of this process then
 * ends. Returns false if the exit status of the job is unknown. */
static bool close_and_wait_for_job(job *j, int *status)
{
    pid_t ended;
    close(j->pipe);
    while ((ended = waitpid(j->pid, status, 0)) < 0 && errno == EINTR)
        continue;
    j->pid = 0;
    j->pipe = -1;
    return ended > 0;
}

/* Set the error of a job that has ended. The error stays empty if the job was stopped or has filmed its last tick. */
static void set_error_of_ended_job(const job_pool *pool, job *j)
{
    const unsigned number = (unsigned)(j - pool->jobs) + 1;
    int status = 0;
    const bool known = close_and_wait_for_job(j, &status);
    if (known && WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS)
        return;
    if (known && WIFSIGNALED(status))
        error_set(&j->error, "job %u of %u was killed by signal %d (%s); --resume records the missing ticks", number,
                  pool->count, WTERMSIG(status), strsignal(WTERMSIG(status)));
    else
        error_set(&j->error, "job %u of %u ended early, with status %d; --resume records the missing ticks", number,
                  pool->count, WEXITSTATUS(status));
}

/* Read the next message of a job. If the job has ended or failed, the message is MESSAGE_NONE. */
static void read_message(const job_pool *pool, job *j)
{
    message *m = &j->message;
    j->has_message = true;
    free(j->bytes);
    j->bytes = NULL;
    if (pipe_read(j->pipe, m, sizeof *m)) {
        j->bytes = malloc(m->size + 1);
        m->step.line = j->bytes;
        if (j->bytes && pipe_read(j->pipe, j->bytes, m->size)) {
            if (m->kind == MESSAGE_FAILED)
                memcpy(&j->error, j->bytes, sizeof j->error);
            m->kind = m->kind == MESSAGE_FAILED ? MESSAGE_NONE : m->kind;
            return;
        }
        if (!j->bytes)
            error_no_memory(&j->error);
    }
    m->kind = MESSAGE_NONE;
    if (errno != 0 && !*j->error.text)
        error_set(&j->error, "cannot read the ticks of a job: %s", strerror(errno));
    if (!*j->error.text)
        set_error_of_ended_job(pool, j);
}

/* Wait until one of the jobs without a message sends a message or ends, and read the message. If the caller's watcher
 * stops the recording during the wait, stop all jobs. Returns false if all jobs have a message. */
static bool wait_for_message(job_pool *pool)
{
    enum { PATIENCE = 50 }; /* milliseconds between two calls of the watcher */
    struct pollfd asked[FILM_MOST_JOBS];
    bool waits = false;
    for (unsigned i = 0; i < pool->count; i++) {
        const job *j = &pool->jobs[i];
        asked[i] = (struct pollfd){.fd = j->has_message ? -1 : j->pipe, .events = POLLIN};
        waits |= !j->has_message;
    }
    if (!waits)
        return false;
    if (!pool->stopped && !watcher_continues(&pool->recording->options->watch))
        stop_jobs(pool);
    if (poll(asked, pool->count, PATIENCE) > 0)
        for (unsigned i = 0; i < pool->count; i++)
            if (asked[i].revents)
                read_message(pool, &pool->jobs[i]);
    return true;
}

/* Returns the job whose next message is the tick. Returns null if no job will send this tick: each job has sent a later
 * tick, has failed, or has ended. */
static job *wait_for_tick(job_pool *pool, uint64_t tick)
{
    do {
        for (job *j = pool->jobs; j < pool->jobs + pool->count; j++)
            if (j->has_message && j->message.kind == MESSAGE_STEP && j->message.step.tick == tick)
                return j;
    } while (wait_for_message(pool));
    return NULL;
}

/* Returns false with an error if a job has failed. */
static bool check_no_job_failed(const job_pool *pool, octreel_error *error)
{
    for (const job *j = pool->jobs; j < pool->jobs + pool->count; j++)
        if (*j->error.text) {
            *error = j->error;
            return false;
        }
    return true;
}

/* Read the ticks in order, each from the job that has filmed the tick, until all ticks are read or the recording is
 * stopped. */
static bool collect_ticks(job_pool *pool, octreel_error *error)
{
    recording *r = pool->recording;
    job *first = pool->jobs;
    for (uint64_t tick = r->share.first; tick < r->share.last; tick++) {
        job *j = wait_for_tick(pool, tick);
        if (!j)
            return check_no_job_failed(pool, error);
        if (!recording_add_tick(r, &j->message.step, error))
            return false;
        j->has_message = false;
    }
    while (!first->has_message)
        wait_for_message(pool);
    if (first->message.kind == MESSAGE_ENDED)
        memcpy(&r->summary->checks, first->bytes, sizeof r->summary->checks);
    else if (*first->error.text)
        *error = first->error;
    return !*first->error.text;
}

/* Stop the jobs and wait until they have ended. Messages of the jobs are read and dropped: a job must finish its frame,
 * and must not wait for room in its socket. */
static void end_jobs(job_pool *pool)
{
    char ignored[1 << 12];
    int status;
    stop_jobs(pool);
    for (job *j = pool->jobs; j < pool->jobs + pool->count; j++) {
        free(j->bytes);
        if (j->pid == 0)
            continue;
        while (pipe_read(j->pipe, ignored, sizeof ignored))
            continue;
        close_and_wait_for_job(j, &status);
    }
    munmap((void *)pool->claims, pool->claim_count);
    free(pool->jobs);
}

/* Start the jobs. Then write the first files of the recording while the jobs begin to draw. */
static bool start_all_jobs(job_pool *pool, playback *p, octreel_error *error)
{
    while (pool->count < pool->wanted)
        if (!start_job(pool, p, error))
            return false;
    /* Free the starter's game: each job has its own copy, and the starter plays no tick. */
    octree_game_destroy(p->game);
    p->game = NULL;
    const bool begun = recording_open_picture(pool->recording, p, error) && recording_begin(pool->recording, p, error);
    picture_close(&p->picture);
    return begun;
}

/* Send the digest of session.json to all jobs. A job that has died is not noticed here, but later, when its messages
 * are read. */
static bool send_session_digest(const job_pool *pool, uint64_t session, octreel_error *error)
{
    for (unsigned i = 0; i < pool->count; i++)
        if (!pipe_write(pool->jobs[i].pipe, &session, sizeof session) && errno != EPIPE && errno != ECONNRESET)
            return error_set(error, "cannot send the session digest to job %u of %u: %s", i + 1, pool->count,
                             strerror(errno));
    return true;
}

/* Allocate the claims, all zero, in memory that all jobs share. Returns false if memory runs out. */
static bool make_claims(job_pool *pool)
{
    const recording *r = pool->recording;
    pool->claim_count = (size_t)share_count_frames(&r->share, r->options->every);
    void *claims = mmap(NULL, pool->claim_count, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    pool->claims = claims == MAP_FAILED ? NULL : claims;
    return pool->claims != NULL;
}

/* The starter has time to make the page while the jobs film, unless it records a chunk, which has no page. */
static bool begin_page(recording *r, page_writer *page, octreel_error *error)
{
    if (recording_is_chunk(r))
        return true;
    r->page = page;
    return page_begin_folder(page, r->options->folder, error);
}

bool film_by_jobs(recording *r, playback *p, unsigned jobs, octreel_error *error)
{
    page_writer page = {0};
    job_pool pool = {.recording = r, .wanted = jobs, .jobs = calloc(jobs, sizeof *pool.jobs)};
    if (!pool.jobs || !make_claims(&pool)) {
        free(pool.jobs);
        return error_no_memory(error);
    }
    const bool begun = start_all_jobs(&pool, p, error);
    bool ok = begun && send_session_digest(&pool, p->session_digest, error) && begin_page(r, &page, error) &&
              collect_ticks(&pool, error);
    end_jobs(&pool);
    ok = begun && recording_end(r, ok, error);
    r->page = NULL;
    page_release(&page);
    return ok;
}
