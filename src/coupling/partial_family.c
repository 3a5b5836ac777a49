/* Finds the neighbours of a particle within the cutoff (largest bond length) by the map of lattice sites, or by a
 * search if there is no map or it does not apply. */
#include "base/memory.h"
#include "partial_parts.h"

void particle_find_family_members(struct neighbour_list *near, const struct bond_source *s,
                                  const struct lattice_site_map *map, const struct particles *p, int64_t particle)
{
    if (map && map->at) {
        if (near->room < map->most) {
            memory_free(near->at);
            *near = (struct neighbour_list){BARE("convert.near", map->most, int32_t), 0, map->most};
        }
        near->n = lattice_site_map_list_neighbours_of_particle(map, p, (int32_t)particle, near->at);
        if (near->n >= 0) return;
    }
    particles_list_neighbours_within_radius(near, s->cells, p, particle, s->family.cutoff, false);
}
