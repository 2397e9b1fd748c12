# SPDX-License-Identifier: GPL-3.0-or-later
"""Two tables of the same runs, of two machines or versions, compared number by number.

A table is a CSV file with a line for each run, columns `run` and `version`, and means as freedom_columns write them.
Two means differ if their difference is one with 95 % confidence by Student's distribution, with Welch's degrees of
freedom (Mean.sign). Of numbers that are the same, one in 20 would differ by chance; of two turns each, one in 40,
because Welch's degrees are careful then.

A run differs if more of its numbers do than chance explains: if so many or more of as many independent numbers, each
with a chance of 5 %, have a probability below CHANCE, or if its only number differs by so much. Several runs share
CHANCE. Numbers of a flow are not independent, so this is a guide. Of 22
made-up normal numbers with a correlation of 0, 0.5 and 0.8, a run that is the same was called different in 0, 0.4 and
1.7 % of cases with two turns, and in 0.1, 2.7 and 5 % with three."""
import csv
import io
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.stats import binom, t

from millfoam.files.data_files import DataError, read_text
from millfoam.readings.means import CONFIDENCE, Mean

from .mean_columns import Row, freedom_columns, freedom_text, mean_of

CHANCE = 0.01  # of as many differing numbers in a run that is the same
ENDS = " ±", ", freedom"  # of the columns after a mean's
AGAIN = "let the study of this version read it again there (Allrun --read)"


@dataclass(frozen=True)
class Number:
    """A number of a run: its column, and its mean here and there."""
    column: str
    here: Mean
    there: Mean

    @property
    def difference(self) -> Mean:
        """Here minus there."""
        return self.here - self.there

    @property
    def is_known(self) -> bool:
        """Whether both means and the error of their difference are known."""
        return bool(np.isfinite(self.difference.value) and self.difference.error > 0)

    @property
    def probability(self) -> float:
        """Of so large a difference, or a larger one, of numbers that are the same."""
        return float(2 * t.sf(abs(self.difference.value) / self.difference.error, self.difference.freedom))

    @property
    def line(self) -> str:
        """As a line of text: column, both means, difference over its error, how much it needs."""
        means = "".join(text(self.column, one).rjust(24) for one in (self.here, self.there))
        if not self.is_known:
            return f"{self.column:<50}{means}   not compared"
        apart = self.difference
        return (f"{self.column:<50}{means}{apart.value / apart.error:9.2f} of {apart.reach / apart.error:.1f}"
                + ("  differs" if apart.sign else ""))


@dataclass(frozen=True)
class ComparedRun:
    """A run that is in both tables: its name, its version here and there, its numbers; probability below which a count
    of differing numbers is no chance, which several runs share."""
    name: str
    versions: tuple[str, str]
    numbers: list[Number]
    chance: float = CHANCE

    @property
    def known(self) -> list[Number]:
        """The numbers that are compared."""
        return [one for one in self.numbers if one.is_known]

    @property
    def differing(self) -> int:
        """How many numbers differ."""
        return sum(one.difference.sign != 0 for one in self.known)

    @property
    def most(self) -> int:
        """How many numbers may differ by chance: one more has a probability below `chance`."""
        counts = np.arange(len(self.known) + 1)
        return int(counts[binom.sf(counts, len(self.known), 1 - CONFIDENCE) < self.chance][0])

    @property
    def differs(self) -> bool:
        """Whether more numbers differ than chance explains; of a single number, whether it differs by more."""
        if len(self.known) == 1:
            return self.known[0].probability < self.chance
        return self.differing > self.most

    @property
    def line(self) -> str:
        """As a line of text."""
        return (f"{self.name}: {self.differing} of {len(self.known)} numbers differ; by chance "
                f"{(1 - CONFIDENCE) * len(self.known):.1f}, at most {self.most}"
                + (": the run differs" if self.differs else ""))


def text(column: str, mean: Mean) -> str:
    """A mean with its error to two digits, and its degrees of freedom; a dash if it is not known."""
    if not np.isfinite(mean.value):
        return "–"
    digits = 1 - int(np.floor(np.log10(mean.error))) if np.isfinite(mean.error) and mean.error > 0 else 2
    return freedom_text(freedom_columns(column, mean), column, int(np.clip(digits, 0, 6)))


def mean_names(columns: Sequence[str]) -> list[str]:
    """Names of the means of a table with these columns."""
    return [one.removesuffix(ENDS[0]) for one in columns if one.endswith(ENDS[0])]


def read_table(path: Path, names: Collection[str]) -> dict[str, Row]:
    """Rows of a table by run, one or more of `names`: means and what belongs to them are numbers, NaN where a place is
    empty, other columns are text. DataError names file, line, column and value of what is not such a table."""
    lines = csv.reader(io.StringIO(read_text(path)))
    columns = next(lines, [])
    for column in ("run", "version", *(f"{name}{end}" for name in mean_names(columns) for end in ("", *ENDS))):
        if column not in columns:
            head = ",".join(columns)
            raise DataError(f"{path}: no column '{column}' in '{head[:60]}{'…' * (len(head) > 60)}'; expected a "
                            f"table of this study with one: {AGAIN}")
    numbers = {f"{name}{end}" for name in mean_names(columns) for end in ("", *ENDS)}
    found: dict[str, Row] = {}
    for cells in lines:
        where = f"{path}, line {lines.line_num}"
        if len(cells) != len(columns):
            raise DataError(f"{where}: {len(cells)} places; expected {len(columns)}, one for each column")
        row: Row = dict(zip(columns, cells))
        if row["run"] not in names or row["run"] in found:
            raise DataError(f"{where}, column run: '{row['run']}'; expected the name of a run of this study, once")
        for column in numbers:
            row[column] = number(row[column], column, where)
        found[row["run"]] = row
    if not found:
        raise DataError(f"{path}: no run; expected a line for each run")
    return found


def number(word: str, column: str, where: str) -> float:
    """A place of a table as a number, NaN if it is empty. DataError if it is none, or below 0 of an error or its
    degrees of freedom."""
    try:
        value = float(word or "nan")
    except ValueError:
        raise DataError(f"{where}, column '{column}': '{word}'; expected a number") from None
    if column.endswith(ENDS) and value < 0:
        raise DataError(f"{where}, column '{column}': {word}; expected 0 or more")
    return value


def require_same(here: dict[str, Row], there: dict[str, Row], path: Path, settings: Sequence[str]) -> None:
    """DataError if the tables do not have the same columns, or a run that both have was made with other settings, which
    are columns; path: of the other table."""
    columns = [list(next(iter(table.values()))) for table in (here, there)]
    for one, other, words in ((*columns, "no column"), (*columns[::-1], "a column")):
        if lacking := [column for column in one if column not in other]:
            raise DataError(f"{path}: {words} '{lacking[0]}'; expected the columns of the table here: {AGAIN}")
    for name in (name for name in here if name in there):
        for column in settings:
            values = [table[name][column] for table in (here, there)]
            if not is_same(*values):
                raise DataError(f"{path}, run {name}, column '{column}': {values[1]}; expected {values[0]}, as here: "
                                "it is another run")


def is_same(one: str, other: str) -> bool:
    """Whether two places of a table are the same text, or numbers that are equal but for round-off."""
    try:
        return bool(np.isclose(float(one), float(other), rtol=1e-9, atol=0))
    except ValueError:
        return one == other


def compared(name: str, here: Row, there: Row, begin: str = "") -> ComparedRun:
    """ComparedRun of the rows of a run, of numbers whose names begin like this. A number that is the same as one before
    in both, as the last of two distances is the first, is left out; and so is one that is known in none."""
    numbers: list[Number] = []
    for column in (one for one in mean_names(list(here)) if one.startswith(begin)):
        pair = mean_of(here, column), mean_of(there, column)
        if any((one.here, one.there) == pair for one in numbers) or all(np.isnan(one.value) for one in pair):
            continue
        numbers.append(Number(column, *pair))
    return ComparedRun(name, (here["version"], there["version"]), numbers)


def lines_of(runs: Sequence[ComparedRun]) -> Iterator[str]:
    """The comparison as text: numbers of each run, then a line for each run and one for all."""
    for run in runs:
        yield f"== {run.name} ({version_words(run.versions)})"
        yield f"{'number (degrees of freedom)':<50}{'here':>24}{'there':>24}   difference in errors"
        yield from (one.line for one in run.numbers)
        yield ""
    yield from (run.line for run in runs)
    count = sum(len(run.known) for run in runs)
    yield (f"all: {sum(run.differing for run in runs)} of {count} numbers differ; by chance "
           f"{(1 - CONFIDENCE) * count:.1f}. Numbers of a flow are correlated: this is a guide")


def version_words(versions: tuple[str, str]) -> str:
    """Versions here and there in words."""
    return f"version {versions[0]}" if len(set(versions)) == 1 else f"version {versions[0]} here, {versions[1]} there"
