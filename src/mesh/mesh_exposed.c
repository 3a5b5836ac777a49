/* Finds the exposed points of the mesh, material points with bonds, loads or mirror images, whose motion must be
 * updated in every step. */
#include "mesh/active_nodes.h"
#include "base/memory.h"
#include "bonds/sites.h"
#include "mesh_parts.h"

/* Flags while exposed points are searched (points whose motion is needed in every step because of bonds, loads or
 * mirror images). point: [particles], cell: [cells]; 1 for exposed points and for cells that contain one. */
struct exposure {
    uint8_t *point, *cell;
};

/* Marks point i of the mesh and the cell that contains it in *e. Exposed points have bonds, loads or mirror images, so
 * that their motion is needed in every step. The writes are atomic, since several threads may set the same flag. */
static void point_expose(struct exposure *e, const struct mesh *mesh, int64_t i)
{
#pragma omp atomic write
    e->point[i] = 1;
    if (mesh->place[i] < 0) return;
#pragma omp atomic write
    e->cell[mesh->place[i] >> mesh->grid.dim] = 1;
}

/* Marks in *e the points of the mesh whose mirror images are among nbr[LANES], the neighbours in one column of bonds
 * (one bond of each of LANES particles): forces of these bonds depend on the motion of the points. Most columns contain
 * no image. p: particles; image: list of images. */
static void images_expose(struct exposure *e, const struct mesh *mesh, const struct particles *p,
                          const struct image *image, const int32_t *nbr)
{
    int32_t most = nbr[0];
    for (int l = 1; l < LANES; l++) most = nbr[l] > most ? nbr[l] : most;
    for (int l = 0; l < LANES && most >= p->n; l++)
        if (nbr[l] >= p->n) point_expose(e, mesh, mirror_image_source_particle(p, image, nbr[l]));
}

/* Returns true if a mirror image of particles p may be among the neighbours in column k (the k-th bonds) of block g of
 * eight rows of b (the bonds of eight particles). */
static bool meets_images(const struct bonds *b, const struct particles *p, int64_t g, int64_t k)
{
    const int64_t first = bond_column_first_neighbour_if_consecutive(b, g, k);
    return first < 0 || first + LANES > p->n;
}

/* Appends cell I to mesh->exposed_list, the cells with exposed points (points whose motion is needed in every step),
 * with a bit for each of its exposed points. exposed[particles]: 1 for exposed points. */
static void cell_expose(struct mesh *mesh, const uint8_t *exposed, int64_t I)
{
    const int corners = 1 << mesh->grid.dim;
    unsigned places = 0;
    for (int q = 0; q < corners; q++) {
        const int32_t i = mesh->point[I * corners + q];
        if (i >= 0 && exposed[i]) places |= 1u << q;
    }
    GROW("mesh.exposed", mesh->exposed_list, mesh->exposed + 1);
    mesh->exposed_list[mesh->exposed++] = (struct mesh_exposed){(int32_t)I, (uint8_t)places};
}

/* Returns eight bits: bit l is set if the particle in lane l of block g of eight rows of b (the bonds of eight
 * particles, stored together) is a point of the mesh. */
static unsigned lanes_in_mesh(const struct mesh *mesh, const struct bonds *b, int64_t g)
{
    unsigned bits = 0;
    for (int l = 0; l < LANES; l++) bits |= (unsigned)(mesh->place[b->particle[g * LANES + l]] >= 0) << l;
    return bits;
}

/* Marks in *e the points of the mesh whose motion is needed in every step because of block g of eight rows of b (the
 * bonds of eight particles of p): points with intact bonds in the block, and points whose mirror images are neighbours
 * there. Peridynamic particles are no points of the mesh, so that most blocks need not be read. l: loads, with the list
 * of images. */
static void row_block_expose(struct exposure *e, const struct mesh *mesh, const struct particles *p,
                             const struct bonds *b, const struct loads *l, int64_t g)
{
    const unsigned points = bond_row_block_has_eight_pd_particles(b, g) ? 0 : lanes_in_mesh(mesh, b, g);
    const unsigned intact = points ? points & bond_row_block_intact_bond_lane_mask(b, g) : 0;
    struct column_copy column;
    for (int lane = 0; lane < LANES; lane++)
        if (intact >> lane & 1) point_expose(e, mesh, b->particle[g * LANES + lane]);
    const int64_t columns =
        bond_row_block_may_have_bonds_to_mirror_images(b, p, g) ? bond_row_block_bond_slots_per_particle(b, g) : 0;
    for (int64_t k = 0; k < columns; k++) {
        if (!meets_images(b, p, g, k)) continue;
        bond_column_read_eight_bonds(&column, b, g, k);
        images_expose(e, mesh, p, l->image, column.nbr);
    }
}

void mesh_list_bonded_or_loaded_points(struct mesh *mesh, const struct particles *p, const struct bonds *b,
                                       const struct loads *l)
{
    if (!mesh->place) return;
    struct exposure e = {NEW("mesh.exposed_points", p->n, uint8_t),
                         mesh_allocate_byte_for_each_cell("mesh.exposed_cells", mesh)};
#pragma omp parallel for schedule(static)
    for (int64_t g = 0; g < b->row_blocks; g++) row_block_expose(&e, mesh, p, b, l, g);
    for (int k = 0; k < l->n; k++) { /* driven points and absorbing faces act on nodes */
        const enum boundary_kind kind = l->load[k].boundary->kind;
        for (int64_t q = 0; q < l->load[k].n && kind != BOUNDARY_VELOCITY && kind != BOUNDARY_ABSORBING; q++)
            point_expose(&e, mesh, l->load[k].particle[q]);
    }
    mesh->exposed = 0;
    for (int64_t I = next_marked_index(e.cell, 0, mesh->grid.n); I < mesh->grid.n;
         I = next_marked_index(e.cell, I + 1, mesh->grid.n))
        cell_expose(mesh, e.point, I);
    memory_free(e.point);
    memory_free(e.cell);
    active_nodes_activate_at_bonded_or_loaded_points(mesh);
}
