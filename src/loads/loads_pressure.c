/* Applies pressure to all free faces of a body.
 *
 * A particle represents a cube (in 2D a square) of a lattice. Each face of the cube without a neighbour contributes its
 * area along its outward normal. Each column of particles along an axis has two ends with equal areas, so that the
 * resultant of a uniform pressure vanishes to the last digit; on a lattice also its moment, as both ends are on one
 * line. Steps of a curved or sloping surface sum to its projected areas. The columns are found as for tractions
 * (loads_columns.c), also for particles that are not on a lattice. A face in a plane of symmetry does not count, since
 * the body continues there. */
#include <math.h>
#include <string.h>

#include "loads/loads.h"
#include "loads_surface.h"
#include "base/memory.h"
#include "data/extent.h"

/* Arguments of end_found, which is called for both ends of each column (line) of particles along one axis. `found` is
 * called with `context` for each end that is a free face. */
struct ends {
    const struct boundary *boundary, *all; /* boundary with axis and side; boundaries of the scene */
    int n;                                 /* number of boundaries of the scene */
    const struct particles *p;
    real spacing; /* lattice spacing [m] */
    pressure_face_fn *found;
    void *context;
};

/* Returns true if the face of particle i in the direction e->boundary->side (-1 or 1) along the axis e->boundary->face
 * is in a plane of symmetry: if the particle is within 0.51 spacings of the plane. The body continues behind the plane,
 * so that this is no free face. */
static bool is_mirrored(const struct ends *e, int32_t i)
{
    const int axis = e->boundary->face;
    for (int k = 0; k < e->n; k++) {
        const struct boundary *m = &e->all[k];
        if (m->kind == BOUNDARY_MIRROR && m->axis == axis && fabs(e->p->X[axis][i] - m->at) < 0.51 * e->spacing)
            return true;
    }
    return false;
}

/* Calls e->found for the free face of particle i, which is the first or last one of a column (line) of particles. Does
 * nothing if the face is in a plane of symmetry. context: e, a struct ends; area: area of the face [m^2]. */
static void end_found(void *context, int32_t i, real area)
{
    const struct ends *e = context;
    if (!is_mirrored(e, i)) e->found(e->context, i, e->boundary->face, e->boundary->side, area);
}

void pressure_boundary_visit_free_faces(const struct boundary *boundary, int boundaries, int number,
                                        const struct particles *p, real spacing, const uint8_t *selected,
                                        pressure_face_fn *visit, void *context)
{
    struct boundary one = boundary[number];
    for (one.face = 0; one.face < p->dim; one.face++)
        for (one.side = -1; one.side <= 1; one.side += 2) {
            struct ends e = {&one, boundary, boundaries, p, spacing, visit, context};
            boundary_face_visit_surface_particles(&one, p, selected, spacing, end_found, &e);
        }
}

/* Appends the face of particle `particle` with outward normal along `axis` towards `side` (-1 or 1) to the list f. */
static void surface_face_add(struct surface_faces *f, int32_t particle, int axis, int side)
{
    GROW("loads.faces", f->face, f->n + 1);
    f->face[f->n++] = (struct surface_face){particle, (uint8_t)axis, (int8_t)side};
}

static void surface_faces_free(struct surface_faces *f)
{
    memory_free(f->face);
    *f = (struct surface_faces){0};
}

/* Arguments of face_pressed: for each particle the sum of the area vectors (area times outward normal) of its free
 * faces, and a list of these faces. Owned by the caller. */
struct pressed {
    real *const *area;           /* by component [particles] [m^2] */
    struct surface_faces *faces; /* list for a pressure that follows the surface; NULL: none */
};

/* Adds a free face of particle i to the area vector of the particle, and appends it to the list of faces if there is a
 * list. The face is normal to `axis`, outwards in the direction `side` (1 or -1). context: area vectors and list
 * (struct pressed); area: area of the face [m^2]. */
static void face_pressed(void *context, int32_t i, int axis, int side, real area)
{
    const struct pressed *a = context;
    a->area[axis][i] += side * area;
    if (a->faces) surface_face_add(a->faces, i, axis, side);
}

/* Prepares load l, a pressure on the reference surface of a body of p: sets its particles to those with a free face,
 * and the factors l->share of its value to the inward area vectors [m^2]. area[dim][p->n]: sum of the outward area
 * vectors of the free faces of each particle [m^2]. Returns false if no particle has a free face. */
static bool pressure_shares(struct load *l, struct particles *p, real *const *area)
{
    uint8_t *chosen = NEW("loads.chosen", p->n, uint8_t);
    for (int d = 0; d < p->dim; d++)
        for (int64_t i = 0; i < p->n; i++) chosen[i] |= area[d][i] != 0;
    load_set_particle_list_from_selected_flags(l, chosen, p);
    for (int d = 0; d < p->dim; d++)
        for (int64_t k = 0; k < l->n; k++) l->share[d][k] = -area[d][l->particle[k]];
    memory_free(chosen);
    return l->n > 0;
}

status load_find_free_faces_under_pressure(struct load *l, const struct boundary *boundary, int boundaries,
                                           int boundary_number, struct particles *p, real spacing)
{
    const struct boundary *b = &boundary[boundary_number];
    const bool follows = b->follow && p->dim > 1; /* in 1D there is nothing to follow */
    real *area[DIM_MAX] = {NULL};
    struct surface_faces faces = {0};
    status s = OK;
    if (b->kind != BOUNDARY_PRESSURE) return OK;
    uint8_t *selected = NEW("loads.selected", p->n, uint8_t);
    const bool any = boundary_select_particles_in_region(b, p, spacing, selected);
    for (int d = 0; d < p->dim; d++) area[d] = NEW("loads.area", p->n, real);
    struct pressed pressed = {area, follows ? &faces : NULL};
    if (any)
        pressure_boundary_visit_free_faces(boundary, boundaries, boundary_number, p, spacing, selected, face_pressed,
                                           &pressed);
    if (!any)
        s = status_set(
            REFUSED,
            "boundary %s: no particle is in its region (%s); check the region and its unit (m if none is written)",
            b->name, particles_describe_bounding_box(p).text);
    else if (follows)
        s = load_surface_make_from_free_faces(l, &faces, boundary, boundaries, p, spacing);
    else if (!pressure_shares(l, p, area))
        s = status_set(REFUSED,
                       "boundary %s: no particle in its region has a free face; let the region contain part of the "
                       "surface of the body",
                       b->name);
    for (int d = 0; d < p->dim; d++) memory_free(area[d]);
    surface_faces_free(&faces);
    memory_free(selected);
    return s;
}
