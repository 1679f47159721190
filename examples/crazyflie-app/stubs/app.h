/* Stands in for the firmware's header of this name. The real one comes from the firmware's tree. */
#ifndef APP_H
#define APP_H

/* The app layer starts this in a task of its own. */
void appMain(void);

#endif
