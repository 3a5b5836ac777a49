/* Neighbours within the cutoff of bonds, from the map of lattice sites where there is one. */
#include "base/memory.h"
#include "partial_parts.h"

void particle_find_family(struct neighbour_list *near, const struct bond_source *s, const struct site_map *map,
                          const struct particles *p, int64_t i)
{
    if (map && map->at) {
        if (near->room < map->most) {
            memory_free(near->at);
            *near = (struct neighbour_list){BARE("convert.near", map->most, int32_t), 0, map->most};
        }
        near->n = site_map_find_neighbours(map, p, (int32_t)i, near->at);
        if (near->n >= 0) return;
    }
    particles_find_near(near, s->cells, p, i, s->family.cutoff, false);
}
