/* Releases the list of hollow cells: mesh cells inside a body whose particles are not created. */
#include "data/hollow.h"

#include "base/memory.h"

void cells_without_particles_free(struct cells_without_particles *hollow)
{
    memory_free(hollow->whole);
    memory_free(hollow->absent);
    *hollow = (struct cells_without_particles){0};
}
