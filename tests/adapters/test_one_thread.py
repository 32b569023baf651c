"""What child processes find in their environment."""

import os

from poinsot.adapters import runner
from poinsot.adapters.one_thread import NAMES, one_thread_each


def test_a_child_process_keeps_to_one_thread_and_its_parent_stays_as_it_was(monkeypatch):
    for name in NAMES:
        monkeypatch.delenv(name, raising=False)
    assert dict(runner.isolated(os.getenv, NAMES, (), 1, 60)) == dict.fromkeys(NAMES, "1")
    assert not set(NAMES) & os.environ.keys()


def test_who_chose_a_number_of_threads_keeps_it(monkeypatch):
    monkeypatch.setenv(NAMES[0], "3")
    with one_thread_each():
        assert [os.environ[name] for name in NAMES] == ["3", "1", "1"]
    assert os.environ[NAMES[0]] == "3"
