"""A computer that lacks what Windows lacks: modules, and names of modules that are there."""

import os
from pathlib import Path

HIDDEN = """
import os, select, signal, socket, sys
for name in ("pty", "tty", "termios", "fcntl", "pwd", "grp", "resource", "readline", "curses", "syslog"):
    sys.modules[name] = None
kept = {"SIGABRT", "SIGFPE", "SIGILL", "SIGINT", "SIGSEGV", "SIGTERM", "SIG_DFL", "SIG_IGN"}
missing = {
    signal: [name for name in dir(signal) if name.startswith("SIG") and name not in kept]
    + ["alarm", "pause", "pthread_kill", "pthread_sigmask", "setitimer", "siginterrupt", "sigwait", "sigpending"],
    os: ["openpty", "ttyname", "ctermid", "set_blocking", "get_blocking", "fork", "forkpty", "wait", "killpg", "nice",
         "getuid", "geteuid", "getgid", "getpgid", "getpgrp", "setsid", "uname", "getloadavg", "sysconf", "mkfifo",
         "chown", "fchown", "fchmod", "O_NOFOLLOW", "O_NONBLOCK", "pread", "pwrite", "sendfile",
         "sched_getaffinity", "sched_setaffinity", "sched_yield"],
    select: ["poll", "epoll"],
    socket: ["AF_UNIX", "SO_REUSEPORT"],
}
for module, names in missing.items():
    for name in set(names) & set(dir(module)):
        delattr(module, name)
"""


def environment(folder: Path) -> dict[str, str]:
    """Variables by which every process of Python, and those that it starts, lacks all this."""
    (folder / "sitecustomize.py").write_text(HIDDEN, encoding="utf-8")
    return {**os.environ, "PYTHONPATH": str(folder)}
