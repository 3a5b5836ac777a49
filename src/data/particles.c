/* Defines the table of all arrays of struct particles, and allocates, grows, sorts, saves and frees them by loops over
 * this table. */
#include "data/particles.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* Functions that return the number of component arrays of a particle field, for the table below; 0 if the field does
 * not exist. dim: dimensions; optional: the optional arrays that the scene needs (sum of WITH_*). */
static int one(int dim, int optional) { return (void)dim, (void)optional, 1; }
static int vector(int dim, int optional) { return (void)optional, dim; }
static int symmetric(int dim, int optional) { return (void)optional, symmetric_tensor_component_count(dim); }
static int if_gradient(int dim, int optional) { return optional & WITH_GRADIENT ? dim * dim : 0; }
static int if_stretch(int dim, int optional) { return optional & WITH_STRETCH ? dim : 0; }
static int if_plastic(int dim, int optional) { return (void)dim, optional & WITH_PLASTIC ? 1 : 0; }
static int if_out_of_plane(int dim, int optional) { return (void)dim, optional & WITH_OUT_OF_PLANE ? 1 : 0; }

static int if_ends(int dim, int optional) { return (void)dim, optional & WITH_ENDS ? 1 : 0; }
static int if_rotates(int dim, int optional) { return optional & WITH_ROTATIONS ? (dim > 2 ? ROTATION : 2) : 0; }
static int if_moment(int dim, int optional) { return optional & WITH_ROTATIONS ? (dim > 2 ? 3 : 1) : 0; }
static int if_strength(int dim, int optional) { return (void)dim, optional & WITH_STRENGTH ? 1 : 0; }
static int if_plastic_correction(int dim, int optional)
{
    return optional & WITH_PLASTIC_CORRECTION ? symmetric_tensor_component_count(dim) : 0;
}
static int if_back_stress(int dim, int optional)
{
    return optional & WITH_BACK_STRESS ? symmetric_tensor_component_count(dim) : 0;
}
static int if_temperature(int dim, int optional) { return (void)dim, optional & WITH_TEMPERATURE ? 1 : 0; }
static int if_mesh_stress(int dim, int optional)
{
    return optional & WITH_MESH_STRESS ? symmetric_tensor_component_count(dim) : 0;
}
static int if_return(int dim, int optional) { return (void)dim, optional & WITH_REVERSION ? 1 : 0; }

/* Row of the table of particle arrays. name: its name in checkpoints; member: pointer in struct particles; type: of
 * an entry; count: function that returns the number of components; unit, meaning: texts for output; in_trials: true
 * if the array is plastic state that a repeated load step must restore. */
#define ROW(name, member, type, count, unit, meaning, in_trials)                                                       \
    {                                                                                                                  \
        name, unit, meaning, offsetof(struct particles, member), sizeof(type), count, in_trials                        \
    }
/* Row of an array that has the same name in checkpoints as in struct particles; TRIAL: plastic state. */
#define FIELD(member, type, count, unit, meaning) ROW(#member, member, type, count, unit, meaning, false)
#define TRIAL(member, type, count, unit, meaning) ROW(#member, member, type, count, unit, meaning, true)

/* Table of all arrays of struct particles: member, type of an entry, number of components, unit and meaning. TRIAL
 * instead of FIELD: plastic state, which a repeated load step must restore. */
const struct particle_field particle_fields[] = {
    FIELD(X, real, vector, "m", "reference position"),
    FIELD(x, real, vector, "m", "position"),
    FIELD(v, real, vector, "m/s", "velocity, half a step behind the position"),
    FIELD(f, real, vector, "N", "bond and applied force"),
    FIELD(mass, real, one, "kg", "mass"),
    FIELD(volume0, real, one, "m^3", "reference volume"),
    FIELD(volume, real, one, "m^3", "current volume"),
    FIELD(stress, real, symmetric, "Pa", "Cauchy stress of material points"),
    FIELD(gradient, real, if_gradient, "1/s", "velocity gradient"),
    FIELD(stretch, real, if_stretch, "1", "axial stretch"),
    TRIAL(plastic_strain, real, if_plastic, "1", "accumulated equivalent plastic strain"),
    TRIAL(plastic_work, real, if_plastic, "J/m^3", "plastic work per reference volume"),
    TRIAL(out_of_plane, real, if_out_of_plane, "Pa", "sigma_zz - nu (sigma_xx + sigma_yy)"),
    ROW("relief", plastic_correction, real, if_plastic_correction, "Pa",
        "plastic stress correction: elastic stress less stress, of points of a mesh", true),
    TRIAL(back_stress, real, if_back_stress, "Pa", "back stress of kinematic hardening"),
    TRIAL(temperature, real, if_temperature, "K", "temperature"),
    TRIAL(mesh_stress, real, if_mesh_stress, "Pa", "stress of points of a mesh in the axes of their cell"),
    FIELD(end_strain, real, if_ends, "1", "what cells add to the mean strain of a point at the end of bonds"),
    FIELD(end_rotation, real, if_rotates, "1", "rotation of a point at the end of bonds"),
    FIELD(end_pull, real, if_ends, "J", "derivative of its neighbourhood's energy by that strain"),
    FIELD(end_moment, real, if_moment, "N m", "moment of its bonds about it"),
    FIELD(low_since, real, if_return, "s", "since when the stress of a peridynamic particle is low"),
    FIELD(strength, real, if_strength, "1", "factor on the critical stretch"),
    FIELD(damage, real, one, "1", "share of broken bonds"),
    FIELD(kind, uint8_t, one, "1", "0 material point, 1 peridynamic"),
    FIELD(material, uint8_t, one, "1", "index of the material"),
    FIELD(body, uint8_t, one, "1", "index of the body"),
    FIELD(flag, uint8_t, one, "1", "sum of flags"),
    FIELD(reversions, uint8_t, if_return, "1", "how often it became a material point again"),
    FIELD(id, int32_t, one, "1", "order in which the scene made them"),
};
const int particle_fields_count = COUNT_OF(particle_fields);

/* Checks at compile time that the table has all arrays of struct particles, so that an added array is not forgotten:
 * the structure must have as many pointers as the table has arrays. Each component of a vector or tensor has its own
 * pointer. */
_Static_assert(sizeof(struct particles) ==
                   offsetof(struct particles, X) + (5 * DIM_MAX + 54 + ROTATION) * sizeof(void *),
               "an array of struct particles is missing in particle_fields");

/* Returns the pointer to component k of an array of p. f: row of the table particle_fields, which has the offset of
 * this pointer in struct particles. The pointer is copied byte by byte, since a `real *` must not be read as a `void
 * *`. */
static void *get(const struct particles *p, const struct particle_field *f, int k)
{
    void *array;
    memcpy(&array, (const char *)p + f->offset + (size_t)k * sizeof array, sizeof array);
    return array;
}

/* Stores `array` as the pointer to component k of an array of p. f: row of the table particle_fields, which has the
 * offset of this pointer in struct particles. */
static void particles_put(struct particles *p, const struct particle_field *f, int k, void *array)
{
    memcpy((char *)p + f->offset + (size_t)k * sizeof array, &array, sizeof array);
}

void *particle_field_array(const struct particles *p, const struct particle_field *f, int k)
{
    INVARIANT(k >= 0 && k < f->count(DIM_MAX, WITH_EVERYTHING));
    return get(p, f, k);
}

void particles_make(struct particles *p, int dim, int64_t particle_count, int optional_arrays)
{
    INVARIANT(dim >= 1 && dim <= DIM_MAX && particle_count >= 0 && particle_count <= INT32_MAX - LANES);
    *p = (struct particles){.n = particle_count, .n_all = particle_count, .n_body = particle_count, .dim = dim};
    p->n_of[KIND_MPM] = particle_count;
    for (const struct particle_field *f = particle_fields; f < particle_fields + particle_fields_count; f++)
        for (int k = 0; k < f->count(dim, optional_arrays); k++)
            particles_put(p, f, k, memory_new(f->name, particle_count + LANES, f->size));
    for (int kind = 0; kind < KINDS; kind++) p->list[kind] = NEW("particles.list", particle_count, int32_t);
    p->list_free = NEW("particles.list_free", particle_count, int32_t);
    particles_rebuild_lists_by_kind(p);
}

void particles_extend_arrays_for_mirror_images(struct particles *p, int64_t image_count, int optional_arrays)
{
    INVARIANT(image_count >= 0 && p->n_all + image_count <= INT32_MAX - LANES);
    int64_t old = p->n_all + LANES, count = old + image_count;
    for (const struct particle_field *f = particle_fields; f < particle_fields + particle_fields_count; f++)
        for (int k = 0; k < f->count(p->dim, optional_arrays); k++)
            particles_put(p, f, k, memory_resize(f->name, get(p, f, k), old, count, f->size));
    p->n_all += image_count;
}

void particles_free(struct particles *p)
{
    for (const struct particle_field *f = particle_fields; f < particle_fields + particle_fields_count; f++)
        for (int k = 0; k < f->count(DIM_MAX, WITH_EVERYTHING); k++) memory_free(get(p, f, k));
    for (int kind = 0; kind < KINDS; kind++) memory_free(p->list[kind]);
    memory_free(p->list_free);
    *p = (struct particles){0};
}

void particles_copy_fields_by_new_index(struct particles *p, const struct particles *previous, const int32_t *new_index,
                                        int optional_arrays)
{
    for (const struct particle_field *f = particle_fields; f < particle_fields + particle_fields_count; f++)
        for (int k = 0; k < f->count(p->dim, optional_arrays); k++) {
            char *to = get(p, f, k);
            const char *from = get(previous, f, k);
            for (int64_t j = 0; j < previous->n; j++)
                if (new_index[j] >= 0) memcpy(to + (size_t)new_index[j] * f->size, from + (size_t)j * f->size, f->size);
        }
}

/* ---- sorting ----------------------------------------------------------------------------------------------------- */

/* Sort key of a particle: layer (z) and row (y) in steps of the spacing, position along x, then id and index for
 * ties. */
struct place {
    int64_t layer, row;
    real along;
    int32_t id, index;
};

/* Compares two sort keys of particles, `left` and `right` (struct place), for array_sort: by layer, row, position along
 * x, id and index. */
static int compare_places(const void *left, const void *right)
{
    const struct place *a = left, *b = right;
    if (a->layer != b->layer) return a->layer < b->layer ? -1 : 1;
    if (a->row != b->row) return a->row < b->row ? -1 : 1;
    if (a->along != b->along) return a->along < b->along ? -1 : 1;
    if (a->id != b->id) return a->id < b->id ? -1 : 1;
    return (a->index > b->index) - (a->index < b->index);
}

void particles_coordinate_range(const struct particles *p, int64_t count, int axis, real *low, real *high)
{
    real least = INFINITY, most = -INFINITY;
    if (count == p->n && p->n_body > p->n) {
        *low = p->low[axis], *high = p->high[axis];
        return;
    }
    const real *X = p->X[axis];
#pragma omp parallel for schedule(static) reduction(min : least) reduction(max : most)
    for (int64_t i = 0; i < count; i++) least = real_min(least, X[i]), most = real_max(most, X[i]);
    *low = least, *high = most;
}

int64_t particles_index_nearest_to_position(const struct particles *p, const real *X)
{
    int64_t nearest = 0;
    real least = INFINITY;
    for (int64_t i = 0; i < p->n; i++) {
        real away = 0;
        for (int d = 0; d < p->dim; d++) away += square(p->X[d][i] - X[d]);
        if (away < least) least = away, nearest = i;
    }
    return nearest;
}

real particles_bounding_box_longest_edge(const struct particles *p)
{
    real low, high, longest = 0;
    for (int d = 0; d < p->dim; d++) {
        particles_coordinate_range(p, p->n, d, &low, &high);
        longest = real_max(longest, high - low);
    }
    return longest;
}

/* Computes place[p->n], the sort keys of all particles of p, from their reference positions. Rows and layers have the
 * width `spacing` [m]. Each border between two rows is a quarter of the spacing below the particles of a row of the
 * lattice, so that round-off cannot split a row. */
static void find_places(const struct particles *p, real spacing, struct place *place)
{
    real low[DIM_MAX] = {0}, high;
    for (int d = 1; d < p->dim; d++) particles_coordinate_range(p, p->n, d, &low[d], &high);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++) {
        int64_t row[DIM_MAX] = {0};
        for (int d = 1; d < p->dim; d++) row[d] = (int64_t)floor((p->X[d][i] - low[d]) / spacing + 0.25);
        place[i] = (struct place){row[2], row[1], p->X[0][i], p->id[i], (int32_t)i};
    }
}

/* Permutes array[n], with entries of `size` bytes, so that entry place[i].index moves to entry i. scratch: working
 * memory of n entries. */
static void permute(char *array, size_t size, const struct place *place, int64_t n, char *scratch)
{
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < n; i++) memcpy(scratch + (size_t)i * size, array + (size_t)place[i].index * size, size);
    array_copy(array, scratch, n, size);
}

/* Returns true if the sort keys place[n] are in ascending order and no two are equal. */
static bool in_order(const struct place *place, int64_t n)
{
    bool sorted = true;
#pragma omp parallel for schedule(static) reduction(&& : sorted)
    for (int64_t i = 1; i < n; i++) sorted = sorted && compare_places(&place[i - 1], &place[i]) < 0;
    return sorted;
}

void particles_sort_by_lattice_rows(struct particles *p, real spacing, int optional_arrays)
{
    INVARIANT(p->n_all == p->n && spacing > 0);
    struct place *place = NEW("particles.place", p->n, struct place);
    find_places(p, spacing, place);
    if (in_order(place, p->n)) { /* a single lattice is created in this order */
        memory_free(place);
        particles_rebuild_lists_by_kind(p);
        return;
    }
    char *scratch = NEW("particles.scratch", p->n * (int64_t)sizeof(real), char);
    array_sort(place, p->n, sizeof *place, compare_places);
    for (const struct particle_field *f = particle_fields; f < particle_fields + particle_fields_count; f++)
        for (int k = 0; k < f->count(p->dim, optional_arrays); k++)
            permute(get(p, f, k), f->size, place, p->n, scratch);
    memory_free(scratch);
    memory_free(place);
    particles_rebuild_lists_by_kind(p);
}

/* Returns true if the eight particles i .. i + 7 of p have the same kind, and either all or none of them are part of a
 * mesh. */
static bool eight_alike(const struct particles *p, int64_t i)
{
    const uint64_t meshed = eight_bytes_as_word(p->flag + i) & EIGHT_TIMES(FLAG_MESHED);
    return eight_bytes_are_equal(p->kind + i) && (meshed == 0 || meshed == EIGHT_TIMES(FLAG_MESHED));
}

/* Appends the indices i .. i + more - 1 to the list, behind its first *n entries, and increases *n by `more`. */
static void list_append(int32_t *list, int64_t *n, int64_t i, int more)
{
    for (int l = 0; l < more; l++) list[*n + l] = (int32_t)i + l;
    *n += more;
}

void particles_rebuild_lists_by_kind(struct particles *p)
{
    for (int kind = 0; kind < KINDS; kind++) p->n_of[kind] = 0;
    p->n_free = 0;
    for (int64_t i = 0; i < p->n;) {
        const int alike = i + LANES <= p->n && eight_alike(p, i) ? LANES : 1, kind = p->kind[i];
        INVARIANT(kind < KINDS);
        list_append(p->list[kind], &p->n_of[kind], i, alike);
        if (kind == KIND_MPM && !(p->flag[i] & FLAG_MESHED)) list_append(p->list_free, &p->n_free, i, alike);
        i += alike;
    }
}

/* Returns true if a particle of p is marked for conversion from material point to peridynamic particle: it lost a bond,
 * has a high stress, or is near another body. Eight particles are tested at a time; entries behind the last particle
 * are mirror images, which never have these flags. */
bool particles_any_is_flagged_for_conversion(const struct particles *p)
{
    uint64_t any = 0;
#pragma omp parallel for simd schedule(static) reduction(| : any)
    for (int64_t i = 0; i < p->n; i += LANES)
        any |= eight_bytes_as_word(p->flag + i) & EIGHT_TIMES(FLAG_LOST_BOND | FLAG_STRESSED | FLAG_NEAR);
    return any != 0;
}

struct position_text position_text(const real *X, int dim, int digits)
{
    struct position_text to = {0};
    for (int d = 0, used = 0; d < dim; d++)
        used += snprintf(to.text + used, sizeof to.text - (size_t)used, "%s%.*g", d > 0 ? ", " : "", digits, X[d]);
    return to;
}

struct position_text particle_position_text(const struct particles *p, int64_t i, int digits)
{
    real X[DIM_MAX];
    particle_reference_position(p, i, X);
    return position_text(X, p->dim, digits);
}

status particles_save_or_load(struct particles *p, int optional_arrays, struct archive *a)
{
    for (const struct particle_field *f = particle_fields; f < particle_fields + particle_fields_count; f++)
        for (int k = 0; k < f->count(p->dim, optional_arrays) && (f->in_trials || a->scope == ARCHIVE_ALL); k++) {
            char name[64];
            snprintf(name, sizeof name, "particles/%s%d", f->name, k);
            TRY(a->exchange(a, name, particle_field_array(p, f, k), (size_t)p->n_all * f->size));
        }
    return OK;
}

real particles_largest_speed_of_list(const struct particles *p, const int32_t *particle_list, int64_t particle_count)
{
    real most = 0;
#pragma omp parallel for schedule(static) reduction(max : most)
    for (int64_t k = 0; k < particle_count; k++) {
        real speed2 = 0;
        for (int d = 0; d < p->dim; d++) speed2 += square(p->v[d][particle_list[k]]);
        most = real_max(most, speed2);
    }
    return sqrt(most);
}

real particles_largest_speed_of_all(const struct particles *p)
{
    return real_max(particles_largest_speed_of_list(p, p->list[KIND_PD], p->n_of[KIND_PD]),
                    particles_largest_speed_of_list(p, p->list[KIND_MPM], p->n_of[KIND_MPM]));
}
