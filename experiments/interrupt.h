// Ctrl-C: the first one asks the program to stop after the current piece of work, a second one ends it.
#pragma once

namespace pbdcheck {

void catch_interrupts();
bool interrupted();

}  // namespace pbdcheck
