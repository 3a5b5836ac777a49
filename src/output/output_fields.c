/* The fields of frames: one table, and what copies them from the particles. A symmetric tensor has VTK's order xx yy zz
 * xy yz xz; components that the space does not have are 0, plane strain has zz. */
#include "output_fields.h"

#include <string.h>

/* Vectors `of`, or the differences of - less, in rows of three; components that the space does not have are 0. */
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

/* One number per particle, at a stride of `columns`. */
static void copy_scalars(float *rows, int64_t first, int64_t end, const real *of, int columns)
{
    for (int64_t i = first; i < end; i++) rows[columns * i] = (float)of[i];
}

static void copy_stress(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    const struct particles *p = s->p;
    /* Place of component k of struct particles in VTK's order; differs only in 2D: xx yy xy. */
    static const int place[DIM_MAX + 1][SYM_MAX] = {{0}, {0}, {0, 1, 3}, {0, 1, 2, 3, 4, 5}};
    float *out = rows;
    memset(out + SYM_MAX * first, 0, (size_t)(SYM_MAX * (end - first)) * sizeof *out);
    for (int k = 0; k < symmetric_count(p->dim); k++)
        copy_scalars(out + place[p->dim][k], first, end, p->stress[k], SYM_MAX);
    for (int64_t i = first; i < end && p->plane_strain; i++) out[SYM_MAX * i + 2] = (float)particle_stress_across(p, i);
}

static void copy_damage(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    copy_scalars(rows, first, end, s->p->damage, 1);
}

static void copy_plastic_strain(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    copy_scalars(rows, first, end, s->p->plastic_strain, 1);
}

static void copy_kind(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    memcpy((uint8_t *)rows + first, s->p->kind + first, (size_t)(end - first));
}

static void copy_push(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    copy_vectors(rows, first, end, s->extra.push, NULL, s->p->dim);
}

static void copy_fragment(const struct frame_source *s, int64_t first, int64_t end, void *rows)
{
    memcpy((int32_t *)rows + first, s->extra.fragment + first, (size_t)(end - first) * sizeof(int32_t));
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
    {"/VTKHDF/Points", HDF_F32, 3, NULL, copy_point},
    {POINT_DATA "displacement", HDF_F32, 3, NULL, copy_displacement},
    {POINT_DATA "velocity", HDF_F32, 3, NULL, copy_velocity},
    {POINT_DATA "stress", HDF_F32, 6, NULL, copy_stress},
    {POINT_DATA "damage", HDF_F32, 1, NULL, copy_damage},
    {POINT_DATA "plastic_strain", HDF_F32, 1, NULL, copy_plastic_strain},
    {POINT_DATA "contact_force", HDF_F32, 3, NULL, copy_push},
    {POINT_DATA "fragment", HDF_I32, 1, NULL, copy_fragment},
    {POINT_DATA "spacing", HDF_F32, 1, NULL, copy_spacing},
    {POINT_DATA "kind", HDF_U8, 1, NULL, copy_kind},
    {POINT_DATA "material", HDF_U8, 1, fill_material, NULL},
    {POINT_DATA "body", HDF_U8, 1, fill_body, NULL},
    {POINT_DATA "id", HDF_I32, 1, fill_id, NULL},
    {"/Cleave/reference", HDF_F64, 0, fill_reference, NULL},
};

static bool field_exists(const struct frame_field *field, const struct frame_source *s)
{
    if (field->copy == copy_plastic_strain) return s->p->plastic_strain != NULL;
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
    return hdf_size(field->type) * (size_t)(field->columns ? field->columns : dim);
}

void frame_field_copy_more(const struct frame_field *field, const struct frame_source *source, void *rows)
{
    const struct frame_source more = {source->extra.more,
                                      {.more = source->extra.more,
                                       .spacing = source->extra.spacing,
                                       .more_spacing = source->extra.more_spacing}};
    if (field_exists(field, &more)) field->copy(&more, 0, more.p->n, rows);
    else memset(rows, 0, (size_t)more.p->n * frame_field_row(field, more.p->dim));
}
