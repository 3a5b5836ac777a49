/* Reads the output frames of a run twice for the HTML page: first for particle sets and ranges of fields, then for the
 * values that fit into the page. */
#include "film.h"

#include <math.h>
#include <string.h>

#include "base/arrays.h"
#include "base/memory.h"

/* Numbers of output frames that the film on the page shows: at most FILM_FRAMES_MOST; at most FRAMES_FEWER, then
 * FRAMES_FEWEST, if more would exceed the byte budget of the page. */
enum { FILM_FRAMES_MOST = 61, FRAMES_FEWER = 21, FRAMES_FEWEST = 11 };
/* Largest values of the 16-bit numbers, unsigned and signed, in which the page stores positions and displacements. */
enum { U16_MOST = 65535, I16_MOST = 32767 };

/* Plastic strain above which a particle counts as yielded [1]. */
static const float YIELDED = 1e-4f;

/* ---- particle sets ----------------------------------------------------------------------------------------------- */

/* Returns an allocated copy of n elements of `size` bytes that begin at `from`. The caller releases it with
 * memory_free. */
static void *copy_of(const void *from, int64_t n, size_t size)
{
    void *to = memory_new("report.set", n, size);
    array_copy(to, from, n, size);
    return to;
}

/* Returns true if the particles of `frame` are those of the particle set s (the particles that consecutive frames have
 * in common): number, reference positions and sizes are equal. */
static bool set_is_of(const struct animation_particle_set *s, const struct output_frame *frame)
{
    bool same = s->n == frame->n && !s->size == !frame->spacing;
    for (int d = 0; same && d < frame->dim; d++) same = arrays_equal(s->X[d], frame->X[d], s->n, sizeof(real));
    return same && (!s->size || arrays_equal(s->size, frame->spacing, s->n, sizeof(float)));
}

static void set_make(struct animation_particle_set *s, const struct output_frame *frame)
{
    const int64_t n = frame->n;
    *s = (struct animation_particle_set){.n = n};
    for (int d = 0; d < frame->dim; d++) s->X[d] = copy_of(frame->X[d], n, sizeof(real));
    if (frame->spacing) s->size = copy_of(frame->spacing, n, sizeof(float));
    s->material = copy_of(frame->material, n, sizeof(uint8_t));
    s->body = copy_of(frame->body, n, sizeof(uint8_t));
    s->state = NEW("report.state", n, uint8_t);
    s->history = NEW("report.history", n, uint32_t);
    s->level = NEW("report.level", n, uint8_t);
    s->first = NEW("report.first", n + 1, int32_t);
    s->member = NEW("report.member", n, int32_t);
}

static void set_free(struct animation_particle_set *s)
{
    for (int d = 0; d < DIM_MAX; d++) memory_free(s->X[d]);
    memory_free(s->size), memory_free(s->material), memory_free(s->body), memory_free(s->state);
    memory_free(s->history), memory_free(s->level), memory_free(s->first), memory_free(s->member);
}

/* Updates s->state[i], the worst that particle i of the particle set s (the particles that consecutive frames have in
 * common) suffers in any output frame, by its damage and plastic strain in `frame`. Also updates s->history[i], a hash
 * of the kinds and fragments of particle i in all output frames. path: file of the frame. */
static void set_mark(struct animation_particle_set *s, const struct output_frame *frame, const char *path)
{
    int columns = 0;
    float *strain = NULL;
    const bool yields = frame_field_read(frame, path, "plastic_strain", &columns, &strain) == OK && columns == 1;
    for (int64_t i = 0; i < s->n; i++) {
        const uint32_t fragment = frame->fragment ? (uint32_t)frame->fragment[i] + 2 : 0;
        if (frame->damage[i] > CRACK_DAMAGE)
            s->state[i] = FILM_CRACKED;
        else if (s->state[i] == FILM_INTACT && (frame->damage[i] > 0 || (yields && strain[i] > YIELDED)))
            s->state[i] = FILM_DAMAGED;
        s->history[i] = (s->history[i] * 31 + frame->kind[i]) * 2654435761u + fragment;
    }
    if (columns > 0) memory_free(strain);
}

/* ---- first reading ----------------------------------------------------------------------------------------------- */

/* Adds an output frame to the film f. Creates a new particle set if the frame does not have the particles of the last
 * set (the particles that consecutive frames have in common), and extends the ranges of displacements and fields by
 * the frame. shown: entry of the frame in the film, in which set and step are stored; path: file of the frame. */
static void frame_scan(struct run_animation *f, struct animation_frame *shown, const struct output_frame *frame,
                       const char *path)
{
    if (f->sets == 0 || !set_is_of(&f->set[f->sets - 1], frame)) {
        GROW("report.sets", f->set, f->sets + 1);
        set_make(&f->set[f->sets++], frame);
    }
    f->dim = frame->dim;
    shown->set = f->sets - 1;
    shown->step = frame->step;
    set_mark(&f->set[shown->set], frame, path);
    for (int d = 0; d < f->dim; d++)
        for (int64_t i = 0; i < frame->n; i++)
            if (isfinite(frame->u[d][i])) f->reach[d] = fmax(f->reach[d], fabs((double)frame->u[d][i]));
    animation_update_field_ranges_from_frame(f, frame, path);
}

/* Returns the k-th of at most `most` numbers that are evenly spread over 0..n-1, with 0 and n-1 included. If n <= most,
 * returns k. */
static int spread(int k, int n, int most) { return n <= most ? k : (int)lround((double)k * (n - 1) / (most - 1)); }

status animation_read_frames_of_run(struct run_animation *f, const char *folder, const struct scene *scene)
{
    struct listed_frame *list = NULL;
    *f = (struct run_animation){.folder = folder, .scene = scene};
    TRY(run_list_frames(folder, &f->listed, &list));
    f->frames = f->listed < FILM_FRAMES_MOST ? f->listed : FILM_FRAMES_MOST;
    f->frame = NEW("report.frames", f->frames, struct animation_frame);
    status s = OK;
    for (int k = 0; s == OK && k < f->frames; k++) {
        struct output_frame frame;
        f->frame[k].listed = list[spread(k, f->listed, f->frames)];
        s = run_read_frame(&frame, folder, f->frame[k].listed.number);
        if (s != OK) break;
        if (k == 0) f->dim = frame.dim, f->spacing = frame_particle_spacing(&frame), animation_list_possible_fields(f);
        frame_scan(f, &f->frame[k], &frame, run_frame_path(folder, f->frame[k].listed.number).text);
        frame_free(&frame);
    }
    memory_free(list);
    animation_choose_stored_field_ranges(f);
    if (s != OK) animation_free(f);
    return s;
}

void animation_free(struct run_animation *f)
{
    for (int k = 0; k < f->sets; k++) set_free(&f->set[k]);
    for (int k = 0; k < f->fields; k++) memory_free(f->field[k].sample);
    memory_free(f->set), memory_free(f->frame);
    *f = (struct run_animation){0};
}

/* ---- budget ------------------------------------------------------------------------------------------------------ */

/* Selects at most `most` of the output frames of film f that were read, evenly spread, to be shown, and sets f->used
 * to their number. */
static void frames_use(struct run_animation *f, int most)
{
    for (int k = 0; k < f->frames; k++) f->frame[k].used = false;
    f->used = f->frames < most ? f->frames : most;
    for (int k = 0; k < f->used; k++) f->frame[spread(k, f->frames, f->used)].used = true;
}

/* Divides the particles of all particle sets of the film f (the frames of a run as the page shows them) into groups,
 * each of which is shown as one particle. A group is a single particle or a cubic cell of particles; f->levels,
 * f->levels_damaged and f->levels_all limit the size of the cells. */
static void film_group(struct run_animation *f)
{
    for (int k = 0; k < f->sets; k++) animation_particle_set_merge_into_groups(&f->set[k], f);
}

/* Returns true if the film f (the frames of a run as the page shows them), with the frames, fields and groups of
 * particles that are selected now, takes at most `budget` bytes on the page. */
static bool fits(const struct run_animation *f, int64_t budget)
{
    const int64_t each = 2 * f->dim + animation_bytes_per_group_and_frame(f), once = 2 * f->dim + 6;
    int64_t bytes = 0;
    for (int k = 0; k < f->sets; k++) bytes += once * f->set[k].groups;
    for (int k = 0; k < f->frames; k++) bytes += f->frame[k].used ? each * f->set[f->frame[k].set].groups : 0;
    return bytes <= budget;
}

/* Adds contents to the film f (the frames of a run as the page shows them) as far as the budget allows: first the
 * fields that are left out if the budget is short, then more frames. budget: largest size of the film on the page
 * [byte]. */
static void film_fill(struct run_animation *f, int64_t budget)
{
    const int used = f->used;
    f->lacks_extra = false;
    f->lacks_extra = !fits(f, budget);
    for (int most = f->frames; most > used; most--) {
        frames_use(f, most);
        if (fits(f, budget)) return;
    }
    frames_use(f, used);
}

void animation_select_content_within_byte_budget(struct run_animation *f, int64_t byte_budget)
{
    frames_use(f, FILM_FRAMES_MOST);
    film_group(f);
    f->lacks_extra = !fits(f, byte_budget);
    if (fits(f, byte_budget)) return;
    frames_use(f, FRAMES_FEWER);
    while (!fits(f, byte_budget) && f->levels < FILM_LEVELS) f->levels++, film_group(f);
    if (!fits(f, byte_budget)) frames_use(f, FRAMES_FEWEST);
    while (!fits(f, byte_budget) && f->levels_damaged < FILM_LEVELS_DAMAGED) f->levels_damaged++, film_group(f);
    while (!fits(f, byte_budget) && f->levels_all < FILM_LEVELS_ALL) f->levels_all++, film_group(f);
    film_fill(f, byte_budget);
}

/* ---- second reading ---------------------------------------------------------------------------------------------- */

/* Writes the coordinate along axis d of the reference positions of all groups (particles shown as one) of the particle
 * set s of film f to the page p, as 16-bit numbers between the smallest and the largest one. */
static void write_positions(struct html_page *p, const struct run_animation *f, const struct animation_particle_set *s,
                            int d)
{
    double *centre = BARE("report.centre", s->groups, double), low = INFINITY, high = -INFINITY;
    uint16_t *stored = BARE("report.stored", s->groups, uint16_t);
    for (int64_t g = 0; g < s->groups; g++) {
        centre[g] = animation_group_centre_coordinate(s, f, g, d);
        low = fmin(low, centre[g]), high = fmax(high, centre[g]);
    }
    for (int64_t g = 0; g < s->groups; g++)
        stored[g] = (uint16_t)lround(high > low ? U16_MOST * (centre[g] - low) / (high - low) : 0);
    json_begin_object_or_list(&p->json, NULL, '{');
    json_write_rounded(&p->json, "low", low, JSON_EXACT);
    json_write_rounded(&p->json, "high", high, JSON_EXACT);
    html_page_add_array(p, "of", PAGE_U16, stored, s->groups);
    json_end_object_or_list(&p->json, '}');
    memory_free(stored), memory_free(centre);
}

/* Writes the displacements of an output frame of film f along axis d for all groups (particles shown as one) of
 * the particle set s to the page p: the mean of u over the particles of each group, divided by the largest
 * displacement f->reach[d], as a signed 16-bit number. u[s->n]: displacements of the particles [m]. */
static void write_displacements(struct html_page *p, const struct run_animation *f,
                                const struct animation_particle_set *s, const float *u, int d)
{
    int16_t *stored = BARE("report.stored", s->groups, int16_t);
    for (int64_t g = 0; g < s->groups; g++) {
        double sum = 0;
        for (int32_t k = s->first[g]; k < s->first[g + 1]; k++) sum += (double)u[s->member[k]];
        const double share = sum / (s->first[g + 1] - s->first[g]) / f->reach[d];
        stored[g] = (int16_t)(isfinite(share) ? lround(I16_MOST * fmin(fmax(share, -1), 1)) : 0);
    }
    html_page_add_array(p, NULL, PAGE_I16, stored, s->groups);
    memory_free(stored);
}

static void write_sizes(struct html_page *p, const struct run_animation *f, const struct animation_particle_set *s)
{
    float *size = BARE("report.size", s->groups, float);
    for (int64_t g = 0; g < s->groups; g++) size[g] = (float)animation_group_drawn_edge_length(s, f, g);
    if (s->size || f->levels > 0) html_page_add_array(p, "size", PAGE_F32, size, s->groups);
    memory_free(size);
}

/* Writes the data that all output frames of the particle set s (the particles that these frames have in common) share
 * to the page p: numbers, reference positions, sizes, and fields that do not change. f: film; frame, path: the first
 * frame of the set and its file. */
static void write_film_set(struct html_page *p, const struct run_animation *f, const struct animation_particle_set *s,
                           const struct output_frame *frame, const char *path)
{
    json_begin_object_or_list(&p->json, NULL, '{');
    json_write_integer(&p->json, "particles", s->n);
    json_write_integer(&p->json, "n", s->groups);
    json_write_integer(&p->json, "scattered", f->dim == 2 && !particles_are_on_lattice(s->X, f->dim, s->n));
    json_begin_object_or_list(&p->json, "X", '[');
    for (int d = 0; d < f->dim; d++) write_positions(p, f, s, d);
    json_end_object_or_list(&p->json, ']');
    write_sizes(p, f, s);
    json_begin_object_or_list(&p->json, "fixed", '{');
    for (int k = 0; k < f->fields; k++)
        if (f->field[k].fixed && animation_field_is_shown(f, &f->field[k]))
            animation_write_field_values_of_frame(p, &f->field[k], s, frame, path);
    json_end_object_or_list(&p->json, '}');
    json_end_object_or_list(&p->json, '}');
}

static status write_sets(struct html_page *p, const struct run_animation *f)
{
    json_begin_object_or_list(&p->json, "sets", '[');
    for (int k = 0; k < f->sets; k++) {
        struct output_frame frame;
        int at = 0;
        while (f->frame[at].set != k) at++;
        const int number = f->frame[at].listed.number;
        TRY(run_read_frame(&frame, f->folder, number));
        write_film_set(p, f, &f->set[k], &frame, run_frame_path(f->folder, number).text);
        frame_free(&frame);
    }
    json_end_object_or_list(&p->json, ']');
    return OK;
}

static void write_fields(struct html_page *p, const struct run_animation *f)
{
    static const char *const scale[] = {"zero", "signs", "least", "category"};
    json_begin_object_or_list(&p->json, "fields", '[');
    for (int k = 0; k < f->fields; k++) {
        const struct animation_field *field = &f->field[k];
        if (!animation_field_is_shown(f, field)) continue;
        json_begin_object_or_list(&p->json, NULL, '{');
        json_write_text(&p->json, "name", field->of->name);
        json_write_text(&p->json, "unit", field->of->unit);
        json_write_text(&p->json, "scale", scale[field->of->scale]);
        json_write_rounded(&p->json, "low", field->low, JSON_TIMING);
        json_write_rounded(&p->json, "high", field->high, JSON_TIMING);
        json_write_rounded(&p->json, "least", field->least, JSON_TIMING);
        json_write_rounded(&p->json, "most", field->most, JSON_TIMING);
        json_end_object_or_list(&p->json, '}');
    }
    json_end_object_or_list(&p->json, ']');
}

static status write_frame(struct html_page *p, const struct run_animation *f, const struct animation_frame *shown)
{
    struct output_frame frame;
    const struct animation_particle_set *s = &f->set[shown->set];
    const struct path path = run_frame_path(f->folder, shown->listed.number);
    TRY(run_read_frame(&frame, f->folder, shown->listed.number));
    if (frame.n != s->n) {
        frame_free(&frame);
        return status_set(FAILED, "%s changed while it was read; repeat the command", path.text);
    }
    json_begin_object_or_list(&p->json, NULL, '{');
    json_write_integer(&p->json, "number", shown->listed.number);
    json_write_integer(&p->json, "step", shown->step);
    json_write_rounded(&p->json, "t", shown->listed.time, JSON_TIMING);
    json_write_integer(&p->json, "set", shown->set);
    json_begin_object_or_list(&p->json, "u", '[');
    for (int d = 0; d < f->dim; d++) write_displacements(p, f, s, frame.u[d], d);
    json_end_object_or_list(&p->json, ']');
    json_begin_object_or_list(&p->json, "values", '{');
    for (int k = 0; k < f->fields; k++)
        if (animation_field_is_shown(f, &f->field[k]) && !f->field[k].fixed)
            animation_write_field_values_of_frame(p, &f->field[k], s, &frame, path.text);
    json_end_object_or_list(&p->json, '}');
    animation_write_rigid_body_motion_of_frame(p, f, &frame, shown->listed.number);
    json_end_object_or_list(&p->json, '}');
    frame_free(&frame);
    return OK;
}

status animation_write_to_page(struct html_page *page, const struct run_animation *f)
{
    json_begin_object_or_list(&page->json, "film", '{');
    json_write_integer(&page->json, "dim", f->dim);
    json_write_rounded(&page->json, "spacing", f->spacing, JSON_TIMING);
    json_write_integer(&page->json, "listed", f->listed);
    json_write_integer(&page->json, "levels", f->levels);
    json_write_integer(&page->json, "levels_damaged", f->levels_damaged);
    json_write_integer(&page->json, "levels_all", f->levels_all);
    json_write_integer(&page->json, "lacks_extra", f->lacks_extra);
    json_begin_object_or_list(&page->json, "reach", '[');
    for (int d = 0; d < f->dim; d++) json_write_rounded(&page->json, NULL, f->reach[d], JSON_TIMING);
    json_end_object_or_list(&page->json, ']');
    write_fields(page, f);
    animation_write_rigid_body_surfaces(page, f);
    TRY(write_sets(page, f));
    json_begin_object_or_list(&page->json, "frames", '[');
    for (int k = 0; k < f->frames; k++)
        if (f->frame[k].used) TRY(write_frame(page, f, &f->frame[k]));
    json_end_object_or_list(&page->json, ']');
    json_end_object_or_list(&page->json, '}');
    return OK;
}
