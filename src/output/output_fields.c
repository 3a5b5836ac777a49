/* Table of the fields of frames, and the functions that copy fields from the particles. Symmetric tensors are in VTK's
 * order xx yy zz xy yz xz. Components that the space lacks are 0, but plane strain has zz. */
#include "output_fields.h"

#include <math.h>
#include <string.h>

#include "data/derived_fields.h"

/* Copies the vectors `of` of particles first..end-1 into rows of three numbers, or the differences of - less if
 * `less` is not NULL. Rows are indexed by particle. Components that the space does not have become 0. */
static ALWAYS_INLINE void copy_vectors(float *rows, int64_t first, int64_t end, real *const *of, real *const *less,
                                       int dim)
{
    for (int64_t i = first; i < end; i++)
        for (int d = 0; d < DIM_MAX; d++)
            rows[DIM_MAX * i + d] = d < dim ? (float)(less ? of[d][i] - less[d][i] : of[d][i]) : 0;
}

static void copy_point(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    copy_vectors(rows, first, end, s->p->x, NULL, s->p->dim);
}

static void copy_displacement(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    copy_vectors(rows, first, end, s->p->x, s->p->X, s->p->dim);
}

static void copy_velocity(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    copy_vectors(rows, first, end, s->p->v, NULL, s->p->dim);
}

/* Copies one number per particle, of particles first..end-1, to rows of `columns` numbers. */
static void copy_scalars(float *rows, int64_t first, int64_t end, const real *of, int columns)
{
    for (int64_t i = first; i < end; i++) rows[columns * i] = (float)of[i];
}

/* Copies the stress of a particle in VTK's order, with the out-of-plane component zz [Pa]. */
static ALWAYS_INLINE void stress_row(const struct particles *p, int64_t i, real *row)
{
    /* Index in VTK's order of component k of struct particles; differs only in 2D, which has xx yy xy. */
    static const int place[DIM_MAX + 1][SYM_MAX] = {{0}, {0}, {0, 1, 3}, {0, 1, 2, 3, 4, 5}};
    for (int k = 0; k < SYM_MAX; k++) row[k] = 0;
    for (int k = 0; k < symmetric_count(p->dim); k++) row[place[p->dim][k]] = p->stress[k][i];
    if (p->plane_strain) row[2] = particle_stress_across(p, i);
}

static void copy_stress(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    for (int64_t i = first; i < end; i++) {
        real row[SYM_MAX];
        stress_row(s->p, i, row);
        for (int k = 0; k < SYM_MAX; k++) ((float *)rows)[SYM_MAX * i + k] = (float)row[k];
    }
}

/* Computes a derived field of particles first..end-1 from their stress or velocity and writes it to
 * rows[end][field->columns]. */
static void copy_derived(const struct derived_field *field, const struct frame_source *s, int64_t first, int64_t end,
                         float *rows)
{
    for (int64_t i = first; i < end; i++) {
        real from[SYM_MAX] = {0}, to[DERIVED_MOST];
        if (field->from == FROM_STRESS) stress_row(s->p, i, from);
        for (int d = 0; d < s->p->dim && field->from == FROM_VELOCITY; d++) from[d] = s->p->v[d][i];
        field->compute(from, to);
        for (int c = 0; c < field->columns; c++) rows[field->columns * i + c] = (float)to[c];
    }
}

/* ---- fields of the displacement gradient ------------------------------------------------------------------------- */

/* Returns the strain zz normal to a plane-stress plane from the stretch F_zz of the thickness [1].
 * An elastic material contracts by nu/(1 - nu) times the sum of the in-plane strains. Plastic flow preserves volume, so
 * that a yielding material has F_zz = J/J_plane with the elastic volume ratio J of its mean stress. */
static real strain_across(const struct frame_source *s, int64_t i, const real *strain)
{
    const struct material *m = &s->extra.material[s->p->material[i]];
    if (s->extra.space != SPACE_PLANE_STRESS) return 0;
    if (!material_yields(m)) return -m->poisson / (1 - m->poisson) * (strain[0] + strain[1]);
    const real plane = sqrt((1 + 2 * strain[0]) * (1 + 2 * strain[1]) - 4 * square(strain[3]));
    const real elastic = 1 + (1 - 2 * m->poisson) / m->young * (s->p->stress[0][i] + s->p->stress[1][i]);
    return 0.5 * (square(elastic / plane) - 1);
}

/* Computes the Green-Lagrange strain E = 1/2 (H + H^T + H^T H) of a particle from its displacement gradient H; E is
 * invariant under rotation. */
static void strain_row(const struct frame_source *s, int64_t i, real *strain)
{
    static const int row[SYM_MAX] = {0, 1, 2, 0, 1, 0}, column[SYM_MAX] = {0, 1, 2, 1, 2, 2};
    real *const *H = s->extra.state.gradient;
    const int dim = s->p->dim;
    for (int k = 0; k < SYM_MAX; k++) {
        const int a = row[k], b = column[k];
        strain[k] = 0;
        if (a >= dim || b >= dim) continue;
        strain[k] = H[a * dim + b][i] + H[b * dim + a][i];
        for (int c = 0; c < dim; c++) strain[k] += H[c * dim + a][i] * H[c * dim + b][i];
        strain[k] *= 0.5;
    }
    if (dim == 2) strain[2] = strain_across(s, i, strain);
}

static void copy_strain(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    for (int64_t i = first; i < end; i++) {
        real strain[SYM_MAX];
        strain_row(s, i, strain);
        for (int k = 0; k < SYM_MAX; k++) ((float *)rows)[SYM_MAX * i + k] = (float)strain[k];
    }
}

/* Fills rows of the density rho_0/J with J^2 = det(1 + 2 E), E the Green-Lagrange strain [kg/m^3]. */
static void copy_density(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    for (int64_t i = first; i < end; i++) {
        real metric[SYM_MAX];
        strain_row(s, i, metric);
        for (int k = 0; k < SYM_MAX; k++) metric[k] = 2 * metric[k] + (k < 3);
        const real square_of_J = tensor_determinant(metric), reference = s->p->mass[i] / s->p->volume0[i];
        ((float *)rows)[i] = (float)(square_of_J > 0 ? reference / sqrt(square_of_J) : reference);
    }
}

static void copy_plastic_work(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    for (int64_t i = first; i < end; i++)
        ((float *)rows)[i] = s->extra.state.plastic_work ? (float)s->extra.state.plastic_work[i] : 0;
}

static void copy_level(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    array_copy((uint8_t *)rows + first, s->extra.state.level + first, end - first, 1);
}

/* ---- further fields ---------------------------------------------------------------------------------------------- */

/* Copies the damage of particles first..end-1. */
static void copy_damage(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    copy_scalars(rows, first, end, s->p->damage, 1);
}

static void copy_plastic_strain(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    const real *strain = s->extra.state.plastic_strain ? s->extra.state.plastic_strain : s->p->plastic_strain;
    copy_scalars(rows, first, end, strain, 1);
}

static void copy_kind(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    array_copy((uint8_t *)rows + first, s->p->kind + first, end - first, 1);
}

static void copy_strength(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    for (int64_t i = first; i < end; i++) ((float *)rows)[i] = (float)s->p->strength[i];
}

static void copy_push(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    copy_vectors(rows, first, end, s->extra.push, NULL, s->p->dim);
}

static void copy_fragment(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    array_copy((int32_t *)rows + first, s->extra.fragment + first, end - first, sizeof(int32_t));
}

static void copy_spacing(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    for (int64_t i = first; i < end; i++)
        ((float *)rows)[i] = (float)(s->p == s->extra.more ? s->extra.more_spacing[i] : s->extra.spacing);
}

static void fill_reference(const struct particles *p, int64_t i, void *row)
{
    for (int d = 0; d < p->dim; d++) ((double *)row)[d] = p->X[d][i];
}

static void fill_material(const struct particles *p, int64_t i, void *row) { *(uint8_t *)row = p->material[i]; }
static void fill_body(const struct particles *p, int64_t i, void *row) { *(uint8_t *)row = p->body[i]; }
static void fill_id(const struct particles *p, int64_t i, void *row) { *(int32_t *)row = p->id[i]; }

#define POINT_DATA "/VTKHDF/PointData/"
const struct frame_field frame_fields[FRAME_FIELDS] = {
    {"/VTKHDF/Points", "m", HDF_F32, 3, NULL, copy_point},
    {POINT_DATA "displacement", "m", HDF_F32, 3, NULL, copy_displacement},
    {POINT_DATA "velocity", "m/s", HDF_F32, 3, NULL, copy_velocity},
    {POINT_DATA "stress", "Pa", HDF_F32, 6, NULL, copy_stress},
    {POINT_DATA "damage", "", HDF_F32, 1, NULL, copy_damage},
    {POINT_DATA "plastic_strain", "", HDF_F32, 1, NULL, copy_plastic_strain},
    {POINT_DATA "contact_force", "N", HDF_F32, 3, NULL, copy_push},
    {POINT_DATA "fragment", "", HDF_I32, 1, NULL, copy_fragment},
    {POINT_DATA "spacing", "m", HDF_F32, 1, NULL, copy_spacing},
    {POINT_DATA "kind", "", HDF_U8, 1, NULL, copy_kind},
    {POINT_DATA "material", "", HDF_U8, 1, fill_material, NULL},
    {POINT_DATA "body", "", HDF_U8, 1, fill_body, NULL},
    {POINT_DATA "id", "", HDF_I32, 1, fill_id, NULL},
    {POINT_DATA "von_mises", "Pa", HDF_F32, 1, NULL, NULL},
    {POINT_DATA "pressure", "Pa", HDF_F32, 1, NULL, NULL},
    {POINT_DATA "principal_stress", "Pa", HDF_F32, 3, NULL, NULL},
    {POINT_DATA "principal_directions", "", HDF_F32, 9, NULL, NULL},
    {POINT_DATA "speed", "m/s", HDF_F32, 1, NULL, NULL},
    {POINT_DATA "strain", "", HDF_F32, 6, NULL, copy_strain},
    {POINT_DATA "density", "kg/m^3", HDF_F32, 1, NULL, copy_density},
    {POINT_DATA "plastic_work", "J/m^3", HDF_F32, 1, NULL, copy_plastic_work},
    {POINT_DATA "level", "", HDF_U8, 1, NULL, copy_level},
    {POINT_DATA "strength", "", HDF_F32, 1, NULL, copy_strength},
    {"/Cleave/reference", "m", HDF_F64, 0, fill_reference, NULL},
};

/* Indices of the fields that are written only if the scene requests them; bit k of the request selects field k + 1. */
enum { FIELD_ON_DEMAND = 13, FIELD_ON_DEMAND_LAST = 21 };

/* Returns true if a frame contains a field: it was requested, if fields of this kind are written on request only, and
 * the data exist. */
static bool field_exists(const struct frame_field *field, const struct frame_source *s)
{
    const int64_t k = field - frame_fields;
    if (k >= FIELD_ON_DEMAND && k <= FIELD_ON_DEMAND_LAST) return s->extra.asked >> (k - 1) & 1;
    if (field->copy == copy_plastic_strain) return s->p->plastic_strain || s->extra.state.plastic_strain;
    if (field->copy == copy_strength) return s->p->strength != NULL;
    if (field->copy == copy_push) return s->extra.push != NULL;
    if (field->copy == copy_fragment) return s->extra.fragment != NULL;
    if (field->copy == copy_spacing) return s->extra.spacing > 0;
    return true;
}

unsigned frame_fields_of(const struct frame_source *s)
{
    unsigned found = 0;
    for (int k = 0; k < FRAME_FIELDS; k++)
        if (field_exists(&frame_fields[k], s)) found |= 1u << k;
    return found;
}

size_t frame_field_row(const struct frame_field *field, int dim)
{
    return hdf_type_size(field->type) * (size_t)(field->columns ? field->columns : dim);
}

void frame_field_copy(const struct frame_field *field, const struct frame_source *source, int64_t first, int64_t end,
                      void *rows)
{
    if (field->copy)
        field->copy(source, first, end, rows);
    else
        copy_derived(derived_field_find(strrchr(field->path, '/') + 1), source, first, end, rows);
}

void frame_field_copy_more(const struct frame_field *field, const struct frame_source *source, void *rows)
{
    struct frame_source more = {source->extra.more, source->extra};
    more.extra.push = NULL, more.extra.fragment = NULL, more.extra.state = source->extra.more_state;
    if (field_exists(field, &more))
        frame_field_copy(field, &more, 0, more.p->n, rows);
    else
        array_fill_bytes(rows, 0, more.p->n, frame_field_row(field, more.p->dim));
}

void frame_units_text(unsigned fields, char *text, size_t room)
{
    size_t used = 0;
    text[0] = '\0';
    for (int k = 0; k < FRAME_FIELDS; k++)
        if (fields >> k & 1 && frame_fields[k].unit[0] && used < room)
            used += (size_t)snprintf(text + used, room - used, "%s [%s]\n", strrchr(frame_fields[k].path, '/') + 1,
                                     frame_fields[k].unit);
}
