/* Table of the fields of output frames, and the functions that copy the fields from the particles. Symmetric tensors
 * have six components in the order of VTK, xx yy zz xy yz xz. Components that do not exist in 1D or 2D are 0, except
 * the out-of-plane stress zz in plane strain. */
#include "output_fields.h"

#include <math.h>
#include <string.h>

#include "data/derived_fields.h"

/* Copies one number per particle to column c of the rows first .. end - 1 of the array `rows`, which has `columns`
 * floats per row. Row r receives of[row[r]], or of[row[r]] - less[row[r]] if `less` is not NULL. row[r]: index of the
 * particle of row r. */
static ALWAYS_INLINE void copy_column(float *rows, int columns, int c, const int32_t *row, int64_t first, int64_t end,
                                      const real *of, const real *less)
{
    for (int64_t r = first; r < end; r++)
        rows[columns * r + c] = (float)(less ? of[row[r]] - less[row[r]] : of[row[r]]);
}

/* Copies vectors of[dim][n], or the differences of - less if `less` is not NULL, to the rows first .. end - 1 of the
 * array `rows` with dim floats per row. row[r]: index of the particle of row r. */
static void copy_vectors(float *rows, const int32_t *row, int64_t first, int64_t end, real *const *of,
                         real *const *less, int dim)
{
    for (int d = 0; d < dim; d++)
        if (less)
            copy_column(rows, dim, d, row, first, end, of[d], less[d]);
        else
            copy_column(rows, dim, d, row, first, end, of[d], NULL);
}

static void copy_point(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    copy_vectors(rows, row, first, end, s->p->x, NULL, s->p->dim);
}

static void copy_displacement(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end,
                              void *rows)
{
    copy_vectors(rows, row, first, end, s->p->x, s->p->X, s->p->dim);
}

static void copy_velocity(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    copy_vectors(rows, row, first, end, s->p->v, NULL, s->p->dim);
}

/* Copies one number per particle, of[row[r]], to the rows r = first .. end - 1 of the array `rows` with one column.
 * row[r]: index of the particle of row r. */
static void copy_scalars(float *rows, const int32_t *row, int64_t first, int64_t end, const real *of)
{
    copy_column(rows, 1, 0, row, first, end, of, NULL);
}

/* Returns how many components of a symmetric tensor, in VTK's order xx yy zz xy yz xz, are stored in `dim`
 * dimensions; the others are 0. */
static inline int tensor_stored(int dim) { return dim == 1 ? 1 : dim == 2 ? 4 : SYM_MAX; }

/* Index in VTK's order xx yy zz xy yz xz of component k of a tensor in struct particles, by dimension. Both orders
 * differ in 2D only, where struct particles has xx yy xy. */
static const int tensor_place[DIM_MAX + 1][SYM_MAX] = {{0}, {0}, {0, 1, 3}, {0, 1, 2, 3, 4, 5}};

/* Copies the stress of particle i of p [Pa] to row[6] in VTK's order xx yy zz xy yz xz. In plane strain this includes
 * the out-of-plane component zz. */
static void stress_row(const struct particles *p, int64_t i, real *row)
{
    for (int k = 0; k < SYM_MAX; k++) row[k] = 0;
    for (int k = 0; k < symmetric_tensor_component_count(p->dim); k++) row[tensor_place[p->dim][k]] = p->stress[k][i];
    if (p->plane_strain) row[2] = particle_out_of_plane_stress(p, i);
}

static void copy_stress(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    const struct particles *p = s->p;
    const int stored = tensor_stored(p->dim);
    for (int k = 0; k < symmetric_tensor_component_count(p->dim); k++)
        copy_column(rows, stored, tensor_place[p->dim][k], row, first, end, p->stress[k], NULL);
    if (p->dim != 2) return;
    for (int64_t r = first; r < end; r++)
        ((float *)rows)[stored * r + 2] = (float)particle_out_of_plane_stress(p, row[r]);
}

/* Computes the rows first .. end - 1 of the array `rows` for a field that is derived from stress or velocity, such as
 * the von Mises stress. s: source of the output frame; row[r]: index of the particle of row r. */
static void copy_derived(const struct derived_field *field, const struct frame_contents *s, const int32_t *row,
                         int64_t first, int64_t end, float *rows)
{
    for (int64_t r = first; r < end; r++) {
        const int64_t i = row[r];
        real from[SYM_MAX] = {0}, to[DERIVED_MOST];
        if (field->from == FROM_STRESS) stress_row(s->p, i, from);
        for (int d = 0; d < s->p->dim && field->from == FROM_VELOCITY; d++) from[d] = s->p->v[d][i];
        field->compute(from, to);
        for (int c = 0; c < field->columns; c++) rows[field->columns * r + c] = (float)to[c];
    }
}

/* ---- fields of the displacement gradient ------------------------------------------------------------------------- */

/* Returns the Green-Lagrange strain 1/2 (F_zz^2 - 1) of particle i of s normal to the plane in plane stress; 0 in other
 * spaces. An elastic material contracts by nu/(1 - nu) times the sum of the in-plane strains. In a yielding material
 * plastic flow preserves volume. There F_zz = J/J_plane, where J is the elastic volume ratio that follows from the mean
 * stress, and J_plane the area ratio in the plane. strain[6]: in-plane strains, in the order xx yy zz xy yz xz. */
static real strain_across(const struct frame_contents *s, int64_t i, const real *strain)
{
    const struct material *m = &s->extra.material[s->p->material[i]];
    if (s->extra.space != SPACE_PLANE_STRESS) return 0;
    if (!material_yields(m)) return -m->poisson / (1 - m->poisson) * (strain[0] + strain[1]);
    const real plane = sqrt((1 + 2 * strain[0]) * (1 + 2 * strain[1]) - 4 * square(strain[3]));
    const real elastic = 1 + (1 - 2 * m->poisson) / m->young * (s->p->stress[0][i] + s->p->stress[1][i]);
    return 0.5 * (square(elastic / plane) - 1);
}

/* Computes strain[6], the Green-Lagrange strain E = 1/2 (H + H^T + H^T H) of particle i of s, from its displacement
 * gradient H, in the order xx yy zz xy yz xz. */
static void strain_row(const struct frame_contents *s, int64_t i, real *strain)
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

static void copy_strain(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    const int stored = tensor_stored(s->p->dim);
    for (int64_t r = first; r < end; r++) {
        real strain[SYM_MAX];
        strain_row(s, row[r], strain);
        for (int k = 0; k < stored; k++) ((float *)rows)[stored * r + k] = (float)strain[k];
    }
}

/* Fills the rows first .. end - 1 with the density rho_0/J [kg/m^3], where J^2 = det(1 + 2 E) and E is the
 * Green-Lagrange strain. row[r]: index of the particle of row r; s: source of the output frame; rows: array with one
 * float per row. */
static void copy_density(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    for (int64_t r = first; r < end; r++) {
        const int64_t i = row[r];
        real metric[SYM_MAX];
        strain_row(s, i, metric);
        for (int k = 0; k < SYM_MAX; k++) metric[k] = 2 * metric[k] + (k < 3);
        const real square_of_J = tensor_determinant(metric), reference = s->p->mass[i] / s->p->volume0[i];
        ((float *)rows)[r] = (float)(square_of_J > 0 ? reference / sqrt(square_of_J) : reference);
    }
}

static void copy_plastic_work(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end,
                              void *rows)
{
    const real *work = s->extra.state.plastic_work;
    if (work)
        copy_scalars(rows, row, first, end, work);
    else
        array_fill_bytes((float *)rows + first, 0, end - first, sizeof(float));
}

/* Copies one byte per particle, of[row[r]], to the rows r = first .. end - 1. row[r]: index of the particle of row
 * r. */
static void copy_bytes(uint8_t *rows, const int32_t *row, int64_t first, int64_t end, const uint8_t *of)
{
    for (int64_t r = first; r < end; r++) rows[r] = of[row[r]];
}

/* Copies one integer per particle, of[row[r]], to the rows r = first .. end - 1. row[r]: index of the particle of row
 * r. */
static void copy_integers(int32_t *rows, const int32_t *row, int64_t first, int64_t end, const int32_t *of)
{
    for (int64_t r = first; r < end; r++) rows[r] = of[row[r]];
}

static void copy_share(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    copy_scalars(rows, row, first, end, s->extra.state.share);
}

static void copy_level(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    copy_bytes(rows, row, first, end, s->extra.state.level);
}

/* ---- further fields ---------------------------------------------------------------------------------------------- */

/* Copies the damage of particles to the rows first .. end - 1: the damage computed for the output frame if there is
 * one, else that stored in struct particles. s: source of the frame; row[r]: index of the particle of row r; rows:
 * array with one float per row. */
static void copy_damage(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    copy_scalars(rows, row, first, end, s->extra.state.damage ? s->extra.state.damage : s->p->damage);
}

static void copy_plastic_strain(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end,
                                void *rows)
{
    copy_scalars(rows, row, first, end,
                 s->extra.state.plastic_strain ? s->extra.state.plastic_strain : s->p->plastic_strain);
}

static void copy_temperature(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    copy_scalars(rows, row, first, end, s->p->temperature);
}

static void copy_kind(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    copy_bytes(rows, row, first, end, s->p->kind);
}

static void copy_push(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    copy_vectors(rows, row, first, end, s->extra.push, NULL, s->p->dim);
}

static void copy_fragment(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    copy_integers(rows, row, first, end, s->extra.fragment);
}

/* ---- fields of the particles file -------------------------------------------------------------------------------- */

/* Copies the spacing of particles [m] to the rows first .. end - 1. Material points of coarse grid cells have larger
 * spacings. s: source of the output frame; row[r]: index of the particle of row r; rows: array with one float per row.
 */
static void copy_spacing(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    for (int64_t r = first; r < end; r++)
        ((float *)rows)[r] = (float)(s->p == s->extra.more ? s->extra.more_spacing[row[r]] : s->extra.spacing);
}

static void copy_strength(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    copy_scalars(rows, row, first, end, s->p->strength);
}

static void copy_reference(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    const int dim = s->p->dim;
    for (int64_t r = first; r < end; r++)
        for (int d = 0; d < dim; d++) ((double *)rows)[dim * r + d] = s->p->X[d][row[r]];
}

static void copy_material(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    const int *number = s->extra.material_number;
    for (int64_t r = first; r < end; r++) {
        const uint8_t own = s->p->material[row[r]];
        ((uint8_t *)rows)[r] = number ? (uint8_t)number[own] : own;
    }
}

static void copy_body(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    copy_bytes(rows, row, first, end, s->p->body);
}

static void copy_id(const struct frame_contents *s, const int32_t *row, int64_t first, int64_t end, void *rows)
{
    copy_integers(rows, row, first, end, s->p->id);
}

const struct frame_field frame_cells[CELL_LISTS] = {{"/VTKHDF/Connectivity", "", HDF_I32, 1, ROW_WHOLE, true, NULL},
                                                    {"/VTKHDF/Offsets", "", HDF_I32, 1, ROW_WHOLE, true, NULL},
                                                    {"/VTKHDF/Types", "", HDF_U8, 1, ROW_WHOLE, true, NULL}};

#define POINT_DATA "/VTKHDF/PointData/"
const struct frame_field frame_fields[FRAME_FIELDS] = {
    {"/VTKHDF/Points", "m", HDF_F32, 3, ROW_VECTOR, false, copy_point},
    {POINT_DATA "displacement", "m", HDF_F32, 3, ROW_VECTOR, false, copy_displacement},
    {POINT_DATA "velocity", "m/s", HDF_F32, 3, ROW_VECTOR, false, copy_velocity},
    {POINT_DATA "stress", "Pa", HDF_F32, 6, ROW_TENSOR, false, copy_stress},
    {POINT_DATA "damage", "", HDF_F32, 1, ROW_WHOLE, false, copy_damage},
    {POINT_DATA "plastic_strain", "", HDF_F32, 1, ROW_WHOLE, false, copy_plastic_strain},
    {POINT_DATA "contact_force", "N", HDF_F32, 3, ROW_VECTOR, false, copy_push},
    {POINT_DATA "fragment", "", HDF_I32, 1, ROW_WHOLE, false, copy_fragment},
    {POINT_DATA "spacing", "m", HDF_F32, 1, ROW_WHOLE, true, copy_spacing},
    {POINT_DATA "kind", "", HDF_U8, 1, ROW_WHOLE, false, copy_kind},
    {POINT_DATA "material", "", HDF_U8, 1, ROW_WHOLE, true, copy_material},
    {POINT_DATA "body", "", HDF_U8, 1, ROW_WHOLE, true, copy_body},
    {POINT_DATA "id", "", HDF_I32, 1, ROW_WHOLE, true, copy_id},
    {POINT_DATA "von_mises", "Pa", HDF_F32, 1, ROW_WHOLE, false, NULL},
    {POINT_DATA "pressure", "Pa", HDF_F32, 1, ROW_WHOLE, false, NULL},
    {POINT_DATA "principal_stress", "Pa", HDF_F32, 3, ROW_WHOLE, false, NULL},
    {POINT_DATA "principal_directions", "", HDF_F32, 9, ROW_WHOLE, false, NULL},
    {POINT_DATA "speed", "m/s", HDF_F32, 1, ROW_WHOLE, false, NULL},
    {POINT_DATA "strain", "", HDF_F32, 6, ROW_TENSOR, false, copy_strain},
    {POINT_DATA "density", "kg/m^3", HDF_F32, 1, ROW_WHOLE, false, copy_density},
    {POINT_DATA "plastic_work", "J/m^3", HDF_F32, 1, ROW_WHOLE, false, copy_plastic_work},
    {POINT_DATA "level", "", HDF_U8, 1, ROW_WHOLE, false, copy_level},
    {POINT_DATA "temperature", "K", HDF_F32, 1, ROW_WHOLE, false, copy_temperature},
    {POINT_DATA "strength_share", "", HDF_F32, 1, ROW_WHOLE, false, copy_share},
    {POINT_DATA "strength", "", HDF_F32, 1, ROW_WHOLE, true, copy_strength},
    {"/Cleave/reference", "m", HDF_F64, 0, ROW_VECTOR, true, copy_reference},
};

/* First and last number of the fields of output frames that are written only if the input file requests them. Bit k of
 * s->extra.asked requests field number k + 1. */
enum { FIELD_ON_DEMAND = 13, FIELD_ON_DEMAND_LAST = 21 };

/* Returns true if an output frame of source s contains `field`, a row of frame_fields: its data exist and, if the
 * field is written on request only, the input file (scene) requests it. */
static bool field_exists(const struct frame_field *field, const struct frame_contents *s)
{
    const int64_t k = field - frame_fields;
    if (k >= FIELD_ON_DEMAND && k <= FIELD_ON_DEMAND_LAST) return s->extra.asked >> (k - 1) & 1;
    if (field->copy == copy_plastic_strain) return s->p->plastic_strain || s->extra.state.plastic_strain;
    if (field->copy == copy_share) return s->extra.state.share && s->extra.asked & ASK_SHARE;
    if (field->copy == copy_temperature) return s->p->temperature != NULL;
    if (field->copy == copy_strength) return s->p->strength != NULL;
    if (field->copy == copy_push) return s->extra.push != NULL;
    if (field->copy == copy_fragment) return s->extra.fragment != NULL;
    if (field->copy == copy_spacing) return s->extra.spacing > 0;
    return true;
}

unsigned frame_contents_field_bits_to_write(const struct frame_contents *source)
{
    unsigned found = 0;
    for (int k = 0; k < FRAME_FIELDS; k++)
        if (field_exists(&frame_fields[k], source)) found |= 1u << k;
    return found;
}

/* Returns the number of stored numbers per row of a field in `dim` dimensions; components that the space lacks are not
 * stored. */
static int field_stored(const struct frame_field *field, int dim)
{
    return field->row == ROW_VECTOR ? dim : field->row == ROW_TENSOR ? tensor_stored(dim) : field->columns;
}

size_t frame_field_bytes_per_row(const struct frame_field *field, int dim)
{
    return hdf_type_size(field->type) * (size_t)field_stored(field, dim);
}

/* Copies the values of a field for the particles row[first] .. row[end - 1] from the source to the rows first .. end -
 * 1 of the array `rows`. */
static void copy_rows(const struct frame_field *field, const struct frame_contents *source, const int32_t *row,
                      int64_t first, int64_t end, void *rows)
{
    if (field->copy)
        field->copy(source, row, first, end, rows);
    else
        copy_derived(derived_field_find_by_name(strrchr(field->path, '/') + 1), source, row, first, end, rows);
}

void frame_field_copy_particle_values_to_rows(const struct frame_field *field, const struct frame_contents *source,
                                              const struct frame_rows *row_order, char *rows)
{
    enum { BLOCK = 4096 }; /* rows that a thread copies at a time */
    const int64_t own = row_order->own, others = row_order->n - own;
    struct frame_contents more = {source->extra.more, source->extra};
#pragma omp parallel for schedule(static)
    for (int64_t first = 0; first < own; first += BLOCK)
        copy_rows(field, source, row_order->index, first, first + BLOCK < own ? first + BLOCK : own, rows);
    if (others == 0) return;
    more.extra.push = NULL, more.extra.fragment = NULL, more.extra.state = source->extra.more_state;
    rows += (size_t)own * frame_field_bytes_per_row(field, source->p->dim);
    if (field_exists(field, &more))
        copy_rows(field, &more, row_order->index + own, 0, others, rows);
    else
        array_fill_bytes(rows, 0, others, frame_field_bytes_per_row(field, source->p->dim));
}

void frame_field_write(struct hdf *file, const struct frame_field *field, int64_t row_count, int dim, const char *rows)
{
    hdf_write_rows_zero_padded(file, field->path, field->type, row_count, field->columns ? field->columns : dim,
                               field_stored(field, dim), rows);
    hdf_write_text_attribute(file, field->path, "unit", field->unit[0] ? field->unit : "1");
}

void frame_fields_list_units_as_text(unsigned field_bits, char *text, size_t capacity)
{
    size_t used = 0;
    text[0] = '\0';
    for (int k = 0; k < FRAME_FIELDS; k++)
        if (field_bits >> k & 1 && frame_fields[k].unit[0] && used < capacity)
            used += (size_t)snprintf(text + used, capacity - used, "%s [%s]\n", strrchr(frame_fields[k].path, '/') + 1,
                                     frame_fields[k].unit);
}
