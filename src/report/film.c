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
static void frame_scan(struct run_animation *animation, struct animation_frame *shown, const struct output_frame *frame,
                       const char *path)
{
    if (animation->sets == 0 || !set_is_of(&animation->set[animation->sets - 1], frame)) {
        GROW("report.sets", animation->set, animation->sets + 1);
        set_make(&animation->set[animation->sets++], frame);
    }
    animation->dim = frame->dim;
    shown->set = animation->sets - 1;
    shown->step = frame->step;
    set_mark(&animation->set[shown->set], frame, path);
    for (int d = 0; d < animation->dim; d++)
        for (int64_t i = 0; i < frame->n; i++)
            if (isfinite(frame->u[d][i])) animation->reach[d] = fmax(animation->reach[d], fabs((double)frame->u[d][i]));
    animation_update_field_ranges_from_frame(animation, frame, path);
}

/* Returns the k-th of at most `most` numbers that are evenly spread over 0..n-1, with 0 and n-1 included. If n <= most,
 * returns k. */
static int spread(int k, int n, int most) { return n <= most ? k : (int)lround((double)k * (n - 1) / (most - 1)); }

status animation_read_frames_of_run(struct run_animation *animation, const char *folder, const struct scene *scene)
{
    struct listed_frame *list = NULL;
    *animation = (struct run_animation){.folder = folder, .scene = scene};
    TRY(run_list_frames(folder, &animation->listed, &list));
    animation->frames = animation->listed < FILM_FRAMES_MOST ? animation->listed : FILM_FRAMES_MOST;
    animation->frame = NEW("report.frames", animation->frames, struct animation_frame);
    status s = OK;
    for (int k = 0; s == OK && k < animation->frames; k++) {
        struct output_frame frame;
        animation->frame[k].listed = list[spread(k, animation->listed, animation->frames)];
        s = run_read_frame(&frame, folder, animation->frame[k].listed.number);
        if (s != OK) break;
        if (k == 0)
            animation->dim = frame.dim, animation->spacing = frame_particle_spacing(&frame),
            animation_list_possible_fields(animation);
        frame_scan(animation, &animation->frame[k], &frame,
                   run_frame_path(folder, animation->frame[k].listed.number).text);
        frame_free(&frame);
    }
    memory_free(list);
    animation_choose_stored_field_ranges(animation);
    if (s != OK) animation_free(animation);
    return s;
}

void animation_free(struct run_animation *animation)
{
    for (int k = 0; k < animation->sets; k++) set_free(&animation->set[k]);
    for (int k = 0; k < animation->fields; k++) memory_free(animation->field[k].sample);
    memory_free(animation->set), memory_free(animation->frame);
    *animation = (struct run_animation){0};
}

/* ---- budget ------------------------------------------------------------------------------------------------------ */

/* Selects at most `most` of the output frames of film that were read, evenly spread, to be shown, and sets
 * animation->used to their number. */
static void frames_use(struct run_animation *animation, int most)
{
    for (int k = 0; k < animation->frames; k++) animation->frame[k].used = false;
    animation->used = animation->frames < most ? animation->frames : most;
    for (int k = 0; k < animation->used; k++)
        animation->frame[spread(k, animation->frames, animation->used)].used = true;
}

/* Divides the particles of all particle sets of the film (the frames of a run as the page shows them) into groups, each
 * of which is shown as one particle. A group is a single particle or a cubic cell of particles; animation->levels,
 * animation->levels_damaged and animation->levels_all limit the size of the cells. */
static void film_group(struct run_animation *animation)
{
    for (int k = 0; k < animation->sets; k++) animation_particle_set_merge_into_groups(&animation->set[k], animation);
}

/* Returns true if the film (the frames of a run as the page shows them), with the frames, fields and groups of
 * particles that are selected now, takes at most `budget` bytes on the page. */
static bool fits(const struct run_animation *animation, int64_t budget)
{
    const int64_t each = 2 * animation->dim + animation_bytes_per_group_and_frame(animation),
                  once = 2 * animation->dim + 6;
    int64_t bytes = 0;
    for (int k = 0; k < animation->sets; k++) bytes += once * animation->set[k].groups;
    for (int k = 0; k < animation->frames; k++)
        bytes += animation->frame[k].used ? each * animation->set[animation->frame[k].set].groups : 0;
    return bytes <= budget;
}

/* Adds contents to the film (the frames of a run as the page shows them) as far as the budget allows: first the fields
 * that are left out if the budget is short, then more frames. budget: largest size of the film on the page [byte]. */
static void film_fill(struct run_animation *animation, int64_t budget)
{
    const int used = animation->used;
    animation->lacks_extra = false;
    animation->lacks_extra = !fits(animation, budget);
    for (int most = animation->frames; most > used; most--) {
        frames_use(animation, most);
        if (fits(animation, budget)) return;
    }
    frames_use(animation, used);
}

void animation_select_content_within_byte_budget(struct run_animation *animation, int64_t byte_budget)
{
    frames_use(animation, FILM_FRAMES_MOST);
    film_group(animation);
    animation->lacks_extra = !fits(animation, byte_budget);
    if (fits(animation, byte_budget)) return;
    frames_use(animation, FRAMES_FEWER);
    while (!fits(animation, byte_budget) && animation->levels < FILM_LEVELS) animation->levels++, film_group(animation);
    if (!fits(animation, byte_budget)) frames_use(animation, FRAMES_FEWEST);
    while (!fits(animation, byte_budget) && animation->levels_damaged < FILM_LEVELS_DAMAGED)
        animation->levels_damaged++, film_group(animation);
    while (!fits(animation, byte_budget) && animation->levels_all < FILM_LEVELS_ALL)
        animation->levels_all++, film_group(animation);
    film_fill(animation, byte_budget);
}

/* ---- second reading ---------------------------------------------------------------------------------------------- */

/* Writes the coordinate along axis d of the reference positions of all groups (particles shown as one) of the particle
 * set s of film to the page p, as 16-bit numbers between the smallest and the largest one. */
static void write_positions(struct html_page *p, const struct run_animation *animation,
                            const struct animation_particle_set *s, int d)
{
    double *centre = BARE("report.centre", s->groups, double), low = INFINITY, high = -INFINITY;
    uint16_t *stored = BARE("report.stored", s->groups, uint16_t);
    for (int64_t g = 0; g < s->groups; g++) {
        centre[g] = animation_group_centre_coordinate(s, animation, g, d);
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

/* Writes the displacements of an output frame of film along axis d for all groups (particles shown as one) of the
 * particle set s to the page p: the mean of u over the particles of each group, divided by the largest displacement
 * animation->reach[d], as a signed 16-bit number. u[s->n]: displacements of the particles [m]. */
static void write_displacements(struct html_page *p, const struct run_animation *animation,
                                const struct animation_particle_set *s, const float *u, int d)
{
    int16_t *stored = BARE("report.stored", s->groups, int16_t);
    for (int64_t g = 0; g < s->groups; g++) {
        double sum = 0;
        for (int32_t k = s->first[g]; k < s->first[g + 1]; k++) sum += (double)u[s->member[k]];
        const double share = sum / (s->first[g + 1] - s->first[g]) / animation->reach[d];
        stored[g] = (int16_t)(isfinite(share) ? lround(I16_MOST * fmin(fmax(share, -1), 1)) : 0);
    }
    html_page_add_array(p, NULL, PAGE_I16, stored, s->groups);
    memory_free(stored);
}

static void write_sizes(struct html_page *p, const struct run_animation *animation,
                        const struct animation_particle_set *s)
{
    float *size = BARE("report.size", s->groups, float);
    for (int64_t g = 0; g < s->groups; g++) size[g] = (float)animation_group_drawn_edge_length(s, animation, g);
    if (s->size || animation->levels > 0) html_page_add_array(p, "size", PAGE_F32, size, s->groups);
    memory_free(size);
}

/* Writes the data that all output frames of the particle set s (the particles that these frames have in common) share
 * to the page p: numbers, reference positions, sizes, and fields that do not change. animation: film; frame, path: the
 * first frame of the set and its file. */
static void write_film_set(struct html_page *p, const struct run_animation *animation,
                           const struct animation_particle_set *s, const struct output_frame *frame, const char *path)
{
    json_begin_object_or_list(&p->json, NULL, '{');
    json_write_integer(&p->json, "particles", s->n);
    json_write_integer(&p->json, "n", s->groups);
    json_write_integer(&p->json, "scattered",
                       animation->dim == 2 && !particles_are_on_lattice(s->X, animation->dim, s->n));
    json_begin_object_or_list(&p->json, "X", '[');
    for (int d = 0; d < animation->dim; d++) write_positions(p, animation, s, d);
    json_end_object_or_list(&p->json, ']');
    write_sizes(p, animation, s);
    json_begin_object_or_list(&p->json, "fixed", '{');
    for (int k = 0; k < animation->fields; k++)
        if (animation->field[k].fixed && animation_field_is_shown(animation, &animation->field[k]))
            animation_write_field_values_of_frame(p, &animation->field[k], s, frame, path);
    json_end_object_or_list(&p->json, '}');
    json_end_object_or_list(&p->json, '}');
}

static status write_sets(struct html_page *p, const struct run_animation *animation)
{
    json_begin_object_or_list(&p->json, "sets", '[');
    for (int k = 0; k < animation->sets; k++) {
        struct output_frame frame;
        int at = 0;
        while (animation->frame[at].set != k) at++;
        const int number = animation->frame[at].listed.number;
        TRY(run_read_frame(&frame, animation->folder, number));
        write_film_set(p, animation, &animation->set[k], &frame, run_frame_path(animation->folder, number).text);
        frame_free(&frame);
    }
    json_end_object_or_list(&p->json, ']');
    return OK;
}

static void write_fields(struct html_page *p, const struct run_animation *animation)
{
    static const char *const scale[] = {"zero", "signs", "least", "category"};
    json_begin_object_or_list(&p->json, "fields", '[');
    for (int k = 0; k < animation->fields; k++) {
        const struct animation_field *field = &animation->field[k];
        if (!animation_field_is_shown(animation, field)) continue;
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

static status write_frame(struct html_page *p, const struct run_animation *animation,
                          const struct animation_frame *shown)
{
    struct output_frame frame;
    const struct animation_particle_set *s = &animation->set[shown->set];
    const struct path path = run_frame_path(animation->folder, shown->listed.number);
    TRY(run_read_frame(&frame, animation->folder, shown->listed.number));
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
    for (int d = 0; d < animation->dim; d++) write_displacements(p, animation, s, frame.u[d], d);
    json_end_object_or_list(&p->json, ']');
    json_begin_object_or_list(&p->json, "values", '{');
    for (int k = 0; k < animation->fields; k++)
        if (animation_field_is_shown(animation, &animation->field[k]) && !animation->field[k].fixed)
            animation_write_field_values_of_frame(p, &animation->field[k], s, &frame, path.text);
    json_end_object_or_list(&p->json, '}');
    animation_write_rigid_body_motion_of_frame(p, animation, &frame, shown->listed.number);
    json_end_object_or_list(&p->json, '}');
    frame_free(&frame);
    return OK;
}

status animation_write_to_page(struct html_page *page, const struct run_animation *animation)
{
    json_begin_object_or_list(&page->json, "film", '{');
    json_write_integer(&page->json, "dim", animation->dim);
    json_write_rounded(&page->json, "spacing", animation->spacing, JSON_TIMING);
    json_write_integer(&page->json, "listed", animation->listed);
    json_write_integer(&page->json, "levels", animation->levels);
    json_write_integer(&page->json, "levels_damaged", animation->levels_damaged);
    json_write_integer(&page->json, "levels_all", animation->levels_all);
    json_write_integer(&page->json, "lacks_extra", animation->lacks_extra);
    json_begin_object_or_list(&page->json, "reach", '[');
    for (int d = 0; d < animation->dim; d++) json_write_rounded(&page->json, NULL, animation->reach[d], JSON_TIMING);
    json_end_object_or_list(&page->json, ']');
    write_fields(page, animation);
    animation_write_rigid_body_surfaces(page, animation);
    TRY(write_sets(page, animation));
    json_begin_object_or_list(&page->json, "frames", '[');
    for (int k = 0; k < animation->frames; k++)
        if (animation->frame[k].used) TRY(write_frame(page, animation, &animation->frame[k]));
    json_end_object_or_list(&page->json, ']');
    json_end_object_or_list(&page->json, '}');
    return OK;
}
