/* Target of fuzz.h: Exodus II files, read as meshes and as particle lists, in 2D and 3D. They are refused in one line,
 * or an accepted mesh has a positive volume and an accepted list finite positions. */
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fuzz.h"
#include "geometry/geometry.h"
#include "scene/particle_list.h"
#include "src/export/netcdf_write.h"

static void check_refusal(void)
{
    if (!status_message()[0] || strchr(status_message(), '\n')) fuzz_fail("refused without a line", status_message());
}

void fuzz_exodus(const uint8_t *bytes, size_t n)
{
    if (n > 0 && bytes[0] == 0x89) return; /* HDF5 crashes over damaged files; crash_message.c reports it */
    const int fd = open("fuzz_mesh.exo", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (fd < 0 || write(fd, bytes, n) != (ssize_t)n) fuzz_fail("cannot write", "fuzz_mesh.exo");
    close(fd);
    for (int dim = 2; dim <= 3; dim++) {
        struct geometry g;
        struct particle_list l;
        status_set(OK, "%s", "");
        if (geometry_read(&g, "fuzz_mesh.exo", dim, 1, NAN) != OK)
            check_refusal();
        else {
            if (g.whole.dim > 0 && !(g.whole.volume > 0)) fuzz_fail("a body without volume", "");
            geometry_free(&g);
        }
        status_set(OK, "%s", "");
        if (particle_list_read(&l, "fuzz_mesh.exo", NULL, dim) != OK)
            check_refusal();
        else {
            for (int64_t i = 0; i < l.n; i++)
                for (int d = 0; d < dim; d++)
                    if (!isfinite(l.X[d][i])) fuzz_fail("a place that is no number", "");
            particle_list_free(&l);
        }
    }
}

/* Writes an Exodus II file to `to`: two squares on six nodes or, if `spheres` is true, their four lower nodes as
 * spheres; with a side set and a node set. */
static void seed_write(FILE *to, bool spheres)
{
    struct netcdf_writer w = {.to = to};
    const int elements = spheres ? 4 : 2, each = spheres ? 1 : 4;
    netcdf_define_dimension(&w, "num_dim", 0, 2), netcdf_define_dimension(&w, "num_el_blk", 0, 1);
    netcdf_define_dimension(&w, "num_side_sets", 0, 1), netcdf_define_dimension(&w, "num_node_sets", 0, 1);
    const int nodes = netcdf_define_dimension(&w, "num_nodes", 0, 6), two = netcdf_define_dimension(&w, "two", 0, 2);
    const int block[2] = {netcdf_define_dimension(&w, "num_el_in_blk", 1, elements),
                          netcdf_define_dimension(&w, "num_nod_per_el", 1, each)};
    const int side = netcdf_define_dimension(&w, "num_side_ss", 1, 1),
              node = netcdf_define_dimension(&w, "num_nod_ns", 1, 2);
    netcdf_define_dimension(&w, "num_att_in_blk", 1, 2);
    netcdf_define_array(&w, "coordx", 0, NETCDF_DOUBLE, 1, &nodes, NULL, NULL);
    netcdf_define_array(&w, "coordy", 0, NETCDF_DOUBLE, 1, &nodes, NULL, NULL);
    netcdf_define_array(&w, "connect", 1, NETCDF_INT, 2, block, "elem_type", spheres ? "SPHERE" : "QUAD4");
    netcdf_define_array(&w, "elem_ss", 1, NETCDF_INT, 1, &side, NULL, NULL);
    netcdf_define_array(&w, "side_ss", 1, NETCDF_INT, 1, &side, NULL, NULL);
    netcdf_define_array(&w, "node_ns", 1, NETCDF_INT, 1, &node, NULL, NULL);
    netcdf_define_array(&w, "attrib", 1, NETCDF_DOUBLE, 2, (const int[]){block[0], two}, NULL, NULL);
    netcdf_write_header(&w);
    netcdf_write_reals(&w, 6, (const real[]){0, 2, 6, 0, 2, 6});
    netcdf_write_reals(&w, 6, (const real[]){0, 0, 0, 3, 3, 3});
    netcdf_write_integers(&w, elements * each, (const int32_t[]){1, 2, 5, 4, 2, 3, 6, 5});
    netcdf_write_integers(&w, 1, (const int32_t[]){2});
    netcdf_write_integers(&w, 1, (const int32_t[]){2});
    netcdf_write_integers(&w, 2, (const int32_t[]){1, 4});
    netcdf_write_reals(&w, 2 * elements, (const real[]){1, 2, 1, 2, 1, 2, 1, 2});
    netcdf_free(&w);
}

uint8_t *fuzz_exodus_seed(int number, size_t *n)
{
    char *text = NULL;
    FILE *to = number < 2 ? open_memstream(&text, n) : NULL;
    if (!to) return NULL;
    seed_write(to, number == 1);
    fclose(to);
    return (uint8_t *)text;
}
