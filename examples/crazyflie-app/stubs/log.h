/* Stands in for the firmware's header of this name: variables by group and name, read by whoever wants to. The real one
 * comes from the firmware's tree. */
#ifndef LOG_H
#define LOG_H

#include <stdint.h>

typedef uint16_t logVarId_t;

logVarId_t logGetVarId(const char *group, const char *name);
float logGetFloat(logVarId_t variable);

/* The group's variables as a table of ours. */
struct stub_log {
    const char *name;
    const void *address;
};
#define LOG_GROUP_START(group) \
    extern const struct stub_log stub_log_##group[]; \
    const struct stub_log stub_log_##group[] = {
#define LOG_ADD(type, name, address) { #name, address },
#define LOG_GROUP_STOP(group) { 0, 0 } };

#endif
