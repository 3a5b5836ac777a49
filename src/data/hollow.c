/* Cells whose particles are not made. */
#include "data/hollow.h"

#include "base/memory.h"

void hollow_free(struct hollow *h)
{
    memory_free(h->whole);
    memory_free(h->absent);
    *h = (struct hollow){0};
}
