"""Work for the workers of a cluster; what they import for it takes no time."""

import os
import signal
import time


def square_or_worse(number: int) -> int:
    """The square; of 3 the worker dies, of 5 it hangs."""
    if number == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    if number == 5:
        time.sleep(600)
    return number * number
