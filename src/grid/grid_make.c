/* Sets up the background grids: positions of the nodes, smallest nodal masses, contact between grids. */
#include <math.h>

#include "base/memory.h"
#include "grid/grid_part.h"

/* Returns the coordinate of one node along `axis` [m], from which those of all nodes follow: mpm.origin of scene s if
 * it is given, else the position of the first mirror across the axis, else `corner`, the lower corner of the body [m].
 * Nodes beyond a mirror move as exact images only if the mirror is on a node or midway between two. */
static real node_coordinate(const struct scene *s, int axis, real corner)
{
    if (s->has_grid_origin) return s->grid_origin[axis];
    for (int b = 0; b < s->boundaries; b++)
        if (s->boundary[b].kind == BOUNDARY_MIRROR && s->boundary[b].axis == axis) return s->boundary[b].at;
    return corner;
}

/* Returns `anchor`, the coordinate of a node [m], shifted by at most half a spacing so that it is midway between two
 * particles of a lattice. site: coordinate of a particle of this lattice [m]; spacing: lattice spacing [m]. */
static real between_particles(real anchor, real site, real spacing)
{
    const real steps = (site - anchor) / spacing - 0.5;
    return anchor + (steps - nearbyint(steps)) * spacing;
}

void grid_choose_reference_node_position(const struct scene *s, const real *body_corner, const real *lattice_site,
                                         bool midway_between_particles, real *node_position)
{
    for (int d = 0; d < s->dim; d++) {
        node_position[d] = node_coordinate(s, d, body_corner[d]);
        if (midway_between_particles && node_position[d] == body_corner[d])
            node_position[d] = between_particles(node_position[d], lattice_site[d], s->spacing);
    }
}

int scene_first_body_of_joined_group(const struct scene *s, int k)
{
    for (int b = 0; b < s->bodies; b++)
        if (s->body[b].joined == b && k-- == 0) return b;
    return -1;
}

/* Allocates the background grids grid->field for scene s. Each body, or group of joined bodies, gets a grid of its own
 * if material points of several bodies may collide: the input file prescribes contact, the problem is not a single
 * static equilibrium, and the grid moves no peridynamic particles. Else allocates a single grid. */
static void make_fields(const struct scene *s, struct grid_method *grid)
{
    const bool meet = !scene_is_single_equilibrium(s) && s->method != METHOD_PD && s->contact_between != CONTACT_NONE &&
                      !coupling_moves_pd_particles_by_grid(s->coupling);
    grid->fields = 1;
    while (meet && scene_first_body_of_joined_group(s, grid->fields) >= 0) grid->fields++;
    grid->field = NEW("engine.fields", grid->fields, struct grid_field);
}

real grid_shape_function_reach_beyond_cell(const struct scene *s)
{
    const real cell = s->cell * s->spacing;
    return s->shape == SHAPE_LINEAR      ? 0
           : s->shape == SHAPE_CUBIC     ? cell
           : s->shape == SHAPE_QUADRATIC ? 0.5 * cell
                                         : 0.5 * s->spacing;
}

/* Initialises the background grids mpm of scene s with particles p: position of the nodes, smallest nodal masses,
 * contact between grids. Unless mpm.origin or a plane of symmetry determines the position of the nodes, a node is at
 * the lower corner of the first body: of the bounding box of its shape, or of its particles if the shape is unbounded.
 * nodes_midway_between_particles: true if bodies have meshes of the undeformed body. */
void background_grids_make(struct grid_method *mpm, const struct scene *s, const struct particles *p,
                           bool nodes_midway_between_particles)
{
    real from[DIM_MAX], to[DIM_MAX], site[DIM_MAX];
    if (!mpm->field) make_fields(s, mpm);
    struct grid *g = &mpm->field[0].grid;
    g->dim = s->dim;
    g->h = s->cell * s->spacing;
    bool bounded = s->body[0].shape.n > 0 && region_compute_bounding_box_if_finite(&s->body[0].shape, s->dim, from, to);
    for (int d = 0; d < s->dim; d++) {
        if (!bounded) {
            particles_coordinate_range(p, p->n, d, &from[d], &to[d]);
            from[d] -= 0.5 * s->spacing;
        }
        site[d] = p->X[d][0];
    }
    grid_choose_reference_node_position(s, from, site, nodes_midway_between_particles, g->anchor);
    real section = scene_cross_section_or_thickness(s), lightest = INFINITY;
    for (int m = 0; m < s->materials; m++) lightest = real_min(lightest, s->material[m].density);
    const real light = !scene_is_single_equilibrium(s) ? GRID_MASS_LIGHT : GRID_MASS_STATIC;
    const real full = lightest * pow(g->h, s->dim) * section;
    mpm->smallest_mass = GRID_MASS_SMALLEST * full;
    g->light_mass = s->transfer == TRANSFER_APIC ? light * full : 0;
    for (int k = 0; k < mpm->fields && mpm->fields > 1; k++) {
        mpm->field[k].grid = *g;
        mpm->field[k].grid.body = 1 + scene_first_body_of_joined_group(s, k);
    }
    grid_contact_free(&mpm->contact);
    mpm->contact = (struct grid_contact){.friction = s->contact_friction,
                                         .spacing = s->spacing,
                                         .half_width = grid_shape_function_reach_beyond_cell(s),
                                         .smallest_mass = GRID_MASS_CONTACT * full,
                                         .began = NAN,
                                         .ended = NAN};
    grid_contact_make(&mpm->contact, mpm->fields);
    mpm->spacing = s->spacing;
    mpm->sort_needed = SORT_ALL;
}

bool grid_has_mirror_plane_between_nodes(const struct grid *g, const struct scene *s)
{
    for (int b = 0; b < s->boundaries; b++) {
        const real nodes = (s->boundary[b].at - g->anchor[s->boundary[b].axis]) / g->h;
        if (s->boundary[b].kind == BOUNDARY_MIRROR && fabs(nodes - nearbyint(nodes)) > 1e-6) return true;
    }
    return false;
}
