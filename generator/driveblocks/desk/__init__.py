"""What is between a person, a line and the time, for `run` and `simulate` alike: clock, keyboard, screen, port, files.

`bus` is the simulated line and `wire` its end at a program; `scenario` is what happens to drives on it, `script` what
is set in a program; `seen` is what a `screen` shows, `record` and `recorder` are what is kept of a run. `words` are
those of the command line that several commands share, `ending` is why a run ends, and which signals end it.
"""
