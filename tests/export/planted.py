"""Mistakes that somebody could make in a writer, each as an edit of its source, and the check that has to find it."""

import importlib.util
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from unittest.mock import patch

from tests.export import test_openplc, test_twincat

from driveblocks.export import openplc, twincat


@dataclass(frozen=True)
class Planted:
    """A mistake: its name, the writer, what is in its source, what instead, and the check that tells."""

    name: str
    writer: ModuleType
    old: str
    new: str
    check: Callable[[], None]

    @property
    def source(self) -> str:
        """The writer's source."""
        return Path(str(self.writer.__file__)).read_text(encoding="utf-8")

    def found(self, folder: Path) -> bool:
        """Whether its check turns red."""
        judge = test_twincat if self.writer is twincat else test_openplc
        name = self.writer.__name__.rpartition(".")[2]
        with patch.object(judge, name, self.planted(folder / "planted.py")):
            judge.written.cache_clear()
            try:
                self.check()
            except (AssertionError, SyntaxError, KeyError):  # also of what reads XML, and of a file that is missing
                return True
            finally:
                judge.written.cache_clear()
        return False

    def planted(self, path: Path) -> ModuleType:
        """The writer with the mistake in it."""
        path.write_text(self.source.replace(self.old, self.new), encoding="utf-8")
        spec = importlib.util.spec_from_file_location("planted", path)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        with patch.dict("sys.modules", planted=module):  # where its data classes look for themselves
            spec.loader.exec_module(module)
        return module


_declared = test_twincat.test_declarations_and_their_comments_are_the_canonical_ones
_bodies = test_twincat.test_bodies_are_the_canonical_ones_and_have_the_hash_of_the_head
_bytes = test_twincat.test_files_are_utf_8_with_a_mark_at_the_start_and_crlf
_ids = test_twincat.test_ids_are_unique_and_always_the_same
_family = test_twincat.test_the_library_of_a_family_lists_what_is_not_of_another
_begin = test_twincat.test_a_project_to_begin_with_has_its_own_files_and_links_its_library
_mine = test_twincat.test_nothing_of_the_user_lies_in_the_library
_tasks = test_twincat.test_tasks_call_the_first_motor_and_in_front_of_it_the_terminal
_order = test_twincat.test_projects_list_parts_in_the_order_of_use_and_every_folder
_all = test_twincat.test_the_library_of_all_lists_every_file_of_its_folder_once_and_nothing_else
_refused = test_twincat.test_what_the_format_cannot_say_is_refused_with_its_place
_canonical = test_openplc.test_a_library_is_the_canonical_texts_in_the_order_of_their_use_and_nothing_else
_first = test_openplc.test_a_first_motor_says_what_its_line_is_and_how_often_it_comes

PLANTED = (
    Planted("the head is lost", twincat, "part.text[: part.element.at] + part", "part", _declared),
    Planted(
        "comments of declarations are lost",
        twincat,
        "    body = f",
        '    text = re.sub(r"; +[(][*].*?[*][)]", ";", text)\n    body = f',
        _declared,
    ),
    Planted(
        "initial values are lost",
        twincat,
        "    body = f",
        '    text = re.sub(r" := [^(]*?;", ";", text)\n    body = f',
        _declared,
    ),
    Planted(
        "only the first section of variables is written",
        twincat,
        "    body = f",
        '    text = text.partition("END_VAR")[0] + "END_VAR"\n    body = f',
        _declared,
    ),
    Planted("bodies are lost", twincat, "CDATA[{part.body}]]", "CDATA[]]", _bodies),
    Planted(
        "comments of bodies are lost", twincat, "{part.body}]]", "{re.sub('[(][*].*?[*][)]', '', part.body)}]]", _bodies
    ),
    Planted("bodies are indented anew", twincat, "{part.body}]]", "{part.body.strip()}]]", _bodies),
    Planted(
        "bodies stand in plain XML, & and < unescaped",
        twincat,
        "<ST><![CDATA[{part.body}]]></ST>",
        "<ST>{part.body}</ST>",
        _bodies,
    ),
    Planted("the end of a CDATA section is let through", twincat, r"\]\]>|[^", "[^", _refused),
    Planted("control characters are let through", twincat, r"\]\]>|[^\t\n\x20-", r"\]\]>|[^\x00-", _refused),
    Planted("no byte order mark", twincat, 'MARK = "\\ufeff"', 'MARK = ""', _bytes),
    Planted("line ends of Unix", twincat, '"\\r\\n"', '"\\n"', _bytes),
    Planted(
        "line ends of Windows in the frame alone",
        twincat,
        "_object(inner: str) -> str:\n",
        "_object(inner: str) -> str:\n    inner = inner.replace(chr(10), chr(13))\n",
        _bytes,
    ),
    Planted("ids at random", twincat, "uuid5(IDS, name)", "__import__('uuid').uuid4()", _ids),
    Planted("ids in another namespace", twincat, "6b1f2c0e", "6b1f2c0f", _ids),
    Planted("one id for all", twincat, "uuid5(IDS, name)", "uuid5(IDS, '')", _ids),
    Planted(
        "a project lists the blocks of other families",
        twincat,
        "for part in parts), *adapter",
        "for part in shelf.parts), *adapter",
        _family,
    ),
    Planted(
        "a project forgets its first motor", twincat, "[*own, *shared], items", "[*own[1:], *shared], items", _begin
    ),
    Planted(
        "a project to begin with links nothing", twincat, "[*own, *shared], items", "[*own, *shared, *items]", _begin
    ),
    Planted("a link leads elsewhere", twincat, "<Link>{escaped(path)}", "<Link>{item.name}", _begin),
    Planted(
        "a first motor lies in the library",
        twincat,
        'f"{MOTOR}/{item.path}": item.text for item in own',
        'f"{LIBRARY}/{item.path}": item.text for item in own',
        _mine,
    ),
    Planted("the terminal is served too slowly", twincat, "1000, 1000 *", "9000, 1000 *", _tasks),
    Planted(
        "a task calls the program of another family",
        twincat,
        'name = f"{drive.prefix}_Motor"',
        'name = "CHF_Motor"',
        _tasks,
    ),
    Planted(
        "a library has no title",
        twincat,
        "<Title>{name}",
        "<Title>",
        test_twincat.test_projects_say_what_a_library_is_saved_by,
    ),
    Planted(
        "a project is sorted",
        twincat,
        "(_compiled(item) for item in items)",
        "(_compiled(item) for item in sorted(items, key=lambda item: item.name))",
        _order,
    ),
    Planted(
        "a project forgets a folder",
        twincat,
        "(*items, *linked) if item.folder)",
        "(*items, *linked)[1:60] if item.folder)",
        _order,
    ),
    Planted("paths of Unix in a project", twincat, '.replace("/", "\\\\")', "", _all),
    Planted(
        "types are written as programs",
        twincat,
        "isinstance(part.element, TypeDecl):\n        text",
        "False:\n        text",
        test_twincat.test_every_part_is_a_file_in_its_folder_and_under_its_name,
    ),
    Planted(
        "a block gets the name of another",
        twincat,
        "name, id_ = part.name, _id(part.name)",
        "name, id_ = part.name.upper(), _id(part.name)",
        test_twincat.test_every_part_is_a_file_in_its_folder_and_under_its_name,
    ),
    Planted("a part is lost", openplc, "for part in one.parts)]", "for part in one.parts[1:])]", _canonical),
    Planted(
        "parts are sorted",
        openplc,
        "for part in one.parts)]",
        "for part in sorted(one.parts, key=lambda part: part.name))]",
        _canonical,
    ),
    Planted("comments are lost", openplc, "*(part.text for", "*(part.text[part.element.at:] for", _canonical),
    Planted(
        "texts run into each other",
        openplc,
        '"\\n".join([_head(one), *(part',
        '"".join([_head(one), *(part',
        _canonical,
    ),
    Planted(
        "a library is of all families", openplc, "for part in one.parts)]", "for part in shelf.parts)]", _canonical
    ),
    Planted(
        "a file has line ends of Windows",
        openplc,
        '{path}": text for',
        '{path}": text.replace("\\n", "\\r\\n") for',
        test_openplc.test_a_text_has_no_mark_no_cr_and_ends_with_its_last_line,
    ),
    Planted(
        "the count is of all families",
        openplc,
        "len(one.parts) - types",
        "len(one.parts)",
        test_openplc.test_the_page_counts_what_a_file_holds,
    ),
    Planted("the line for 32 drives is taken", openplc, "port, line, *_ =", "port, _, line =", _first),
    Planted("a task of another interval", openplc, "scan=SCAN_MS", "scan=100", _first),
    Planted("a first motor without its task", openplc, 'f"{program}\\n{_task(other)}"', "program", _first),
)
