"""The 24 tasks: a folder each, with the reference program, its templates and what must be true of an edited mesh."""

from benchmark.tasks.task import DIFFICULTIES, TASKS, EditResult, Task, read_task, task, tasks

__all__ = ["DIFFICULTIES", "TASKS", "EditResult", "Task", "read_task", "task", "tasks"]
