//! A run's numbers in columns, as programs that compute with whole arrays want them.

use super::RecordError;

/// Most memory that the rows of one table take (bytes).
pub const MOST_BYTES: usize = 2 << 30;

/// How a number is read off a row: one of the row's own, or one of each robot in it, appended in their order.
pub enum Read<R> {
    /// A number of the row, 64 bits.
    Number(fn(&R) -> f64),
    /// A number of the row, 32 bits; what is absent is not a number.
    Single(fn(&R) -> f32),
    /// A whole number of the row.
    Count(fn(&R) -> u32),
    /// Yes or no, of the row.
    Flag(fn(&R) -> bool),
    /// A number of each robot; what is absent is not a number.
    Singles(fn(&R, &mut Vec<f32>)),
    /// A whole number of each robot.
    Counts(fn(&R, &mut Vec<u32>)),
    /// Yes or no, of each robot.
    Flags(fn(&R, &mut Vec<bool>)),
    /// One of these words, of each robot, by its place among them.
    Words(&'static [&'static str], fn(&R, &mut Vec<u8>)),
}

impl<R> Read<R> {
    fn is_per_robot(&self) -> bool {
        matches!(self, Self::Singles(_) | Self::Counts(_) | Self::Flags(_) | Self::Words(..))
    }

    fn bytes(&self) -> usize {
        match self {
            Self::Number(_) => 8,
            Self::Single(_) | Self::Count(_) | Self::Singles(_) | Self::Counts(_) => 4,
            Self::Flag(_) | Self::Flags(_) | Self::Words(..) => 1,
        }
    }

    fn values(&self) -> Values {
        match self {
            Self::Number(_) => Values::Numbers(Vec::new()),
            Self::Single(_) | Self::Singles(_) => Values::Singles(Vec::new()),
            Self::Count(_) | Self::Counts(_) => Values::Counts(Vec::new()),
            Self::Flag(_) | Self::Flags(_) => Values::Flags(Vec::new()),
            Self::Words(words, _) => Values::Words(words, Vec::new()),
        }
    }
}

/// A column of rows of a kind: its name with its unit, and how it is read.
pub type Series<R> = (&'static str, Read<R>);

/// The values of a column, row by row.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Numbers, 64 bits.
    Numbers(Vec<f64>),
    /// Numbers, 32 bits.
    Singles(Vec<f32>),
    /// Whole numbers.
    Counts(Vec<u32>),
    /// Yes or no.
    Flags(Vec<bool>),
    /// Words, by their places among these.
    Words(&'static [&'static str], Vec<u8>),
}

/// A column.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name, with its unit.
    pub name: &'static str,
    /// Whether it holds a value of each robot in each row, one after another; else one value in each row.
    pub is_per_robot: bool,
    /// The values.
    pub values: Values,
}

/// Numbers in columns of the same number of rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Its name.
    pub name: &'static str,
    /// Rows.
    pub rows: usize,
    /// Robots in each row.
    pub crew: usize,
    /// Its columns.
    pub columns: Vec<Column>,
}

/// A table under way.
pub struct Rows<R: 'static> {
    name: &'static str,
    series: &'static [Series<R>],
    values: Vec<Values>,
    count: usize,
    crew: usize,
}

impl<R: 'static> std::fmt::Debug for Rows<R> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Rows").field("name", &self.name).field("count", &self.count).finish_non_exhaustive()
    }
}

impl<R: 'static> Rows<R> {
    /// A table of so many robots that may come to have `most_rows` rows.
    ///
    /// # Errors
    /// [`RecordError::TooMuch`] if these would take more than [`MOST_BYTES`].
    pub fn new(
        name: &'static str,
        series: &'static [Series<R>],
        crew: usize,
        most_rows: u64,
    ) -> Result<Self, RecordError> {
        let values = series.iter().map(|(_, read)| read.values()).collect();
        let rows = Self { name, series, values, count: 0, crew };
        rows.check(most_rows)?;
        Ok(rows)
    }

    /// What so many rows would take must not be too much.
    fn check(&self, rows: u64) -> Result<(), RecordError> {
        let width = |read: &Read<R>| if read.is_per_robot() { self.crew } else { 1 };
        let row_bytes: usize = self.series.iter().map(|(_, read)| width(read) * read.bytes()).sum();
        let bytes = u128::from(rows) * row_bytes as u128;
        if bytes <= MOST_BYTES as u128 {
            return Ok(());
        }
        let gib = |bytes: u128| bytes as f64 / f64::from(1 << 30);
        Err(RecordError::TooMuch { name: self.name, gib: gib(bytes), most_gib: gib(MOST_BYTES as u128) })
    }

    /// Makes room for so many rows at once: a table whose length is known takes no more memory than its values.
    #[must_use]
    pub fn with_room(mut self, rows: u64) -> Self {
        // What is too much has been refused, so it is no more than fits.
        let rows = usize::try_from(rows).unwrap_or(0);
        for ((_, read), values) in self.series.iter().zip(&mut self.values) {
            let count = if read.is_per_robot() { rows * self.crew } else { rows };
            match values {
                Values::Numbers(values) => values.reserve_exact(count),
                Values::Singles(values) => values.reserve_exact(count),
                Values::Counts(values) => values.reserve_exact(count),
                Values::Flags(values) => values.reserve_exact(count),
                Values::Words(_, values) => values.reserve_exact(count),
            }
        }
        self
    }

    /// One row more.
    ///
    /// # Errors
    /// [`RecordError::TooMuch`]: nobody knew that there would be so many.
    pub fn push(&mut self, row: &R) -> Result<(), RecordError> {
        self.check(self.count as u64 + 1)?;
        self.count += 1;
        let full = self.count * self.crew;
        for ((_, read), values) in self.series.iter().zip(&mut self.values) {
            match (read, values) {
                (Read::Number(of), Values::Numbers(to)) => to.push(of(row)),
                (Read::Single(of), Values::Singles(to)) => to.push(of(row)),
                (Read::Count(of), Values::Counts(to)) => to.push(of(row)),
                (Read::Flag(of), Values::Flags(to)) => to.push(of(row)),
                // Of a robot that a row does not speak of, nothing is known.
                (Read::Singles(of), Values::Singles(to)) => {
                    of(row, to);
                    to.resize(full, f32::NAN);
                }
                (Read::Counts(of), Values::Counts(to)) => {
                    of(row, to);
                    to.resize(full, 0);
                }
                (Read::Flags(of), Values::Flags(to)) => {
                    of(row, to);
                    to.resize(full, false);
                }
                (Read::Words(_, of), Values::Words(_, to)) => {
                    of(row, to);
                    to.resize(full, 0);
                }
                // Values are what their series says.
                _ => {}
            }
        }
        Ok(())
    }

    /// The whole table.
    pub fn table(self) -> Table {
        let columns = self.series.iter().zip(self.values).map(|((name, read), values)| Column {
            name,
            is_per_robot: read.is_per_robot(),
            values,
        });
        Table { name: self.name, rows: self.count, crew: self.crew, columns: columns.collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SERIES: &[Series<Vec<f32>>] = &[
        ("sum_m", Read::Number(|row| row.iter().copied().map(f64::from).sum())),
        ("x_m", Read::Singles(|row, to| to.extend(row))),
        ("is_far", Read::Flags(|row, to| to.extend(row.iter().map(|x_m| *x_m > 2.0)))),
    ];

    #[test]
    fn every_row_is_as_wide_as_the_crew_whatever_it_speaks_of() {
        let mut rows = Rows::new("frames", SERIES, 2, 3).unwrap();
        for row in [vec![1.0, 3.0], vec![4.0], vec![5.0, 6.0, 7.0]] {
            rows.push(&row).unwrap();
        }
        let table = rows.table();
        assert_eq!((table.rows, table.crew), (3, 2));
        let Values::Singles(x_m) = &table.columns[1].values else { panic!("{:?}", table.columns[1]) };
        assert_eq!(&x_m[..3], [1.0, 3.0, 4.0]);
        assert!(x_m[3].is_nan());
        assert_eq!(&x_m[4..], [5.0, 6.0]);
        assert_eq!(table.columns[2].values, Values::Flags(vec![false, true, true, false, true, true]));
        assert_eq!(table.columns[0].values, Values::Numbers(vec![4.0, 4.0, 18.0]));
        assert!(table.columns[1].is_per_robot && !table.columns[0].is_per_robot);
    }

    #[test]
    fn a_table_of_known_length_has_room_for_it_and_no_more() {
        let mut rows = Rows::new("frames", SERIES, 2, 3).unwrap().with_room(3);
        for _ in 0..3 {
            rows.push(&vec![1.0, 3.0]).unwrap();
        }
        let table = rows.table();
        let Values::Singles(x_m) = &table.columns[1].values else { panic!("{:?}", table.columns[1]) };
        assert_eq!((x_m.len(), x_m.capacity()), (6, 6));
    }

    #[test]
    fn rows_that_would_take_too_much_are_refused_before_the_first_one() {
        let row_bytes = 8 + 4 * 5;
        let most = (MOST_BYTES / row_bytes) as u64;
        assert!(Rows::new("frames", SERIES, 4, most).is_ok());
        let error = Rows::new("frames", SERIES, 4, most + 1).unwrap_err();
        assert!(error.to_string().contains("more than 2"), "{error}");
    }
}
