//! How tunables are declared: one list gives the struct, its defaults, its legal ranges and its help text.

/// What is known of one tunable: read by file checks and by help, never by a law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Key {
    /// The field's name, unit included; the same in a scenario file.
    pub name: &'static str,
    /// Smallest and largest legal value, both included, in the unit of the name; `None` where any value of the type is
    /// legal.
    pub range: Option<(f64, f64)>,
    /// The field's doc comment, line by line: meaning and unit, then a list of symbol, equation and source.
    pub doc: &'static str,
}

/// A tunable outside its legal range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutOfRange {
    /// The field's name.
    pub key: &'static str,
    /// The value found (NaN and infinities included), in the unit of the name, as are both bounds.
    pub got: f64,
    /// Smallest legal value.
    pub low: f64,
    /// Largest legal value.
    pub high: f64,
}

impl core::fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{} = {}: must lie in {}..={}", self.key, self.got, self.low, self.high)
    }
}

impl core::error::Error for OutOfRange {}

/// Declares a struct of tunables.
///
/// Each line is `pub name: Type = default, in low..=high;`. The range is left out for switches, choices and
/// whatever is not a single number. If every field has a default, the struct gets `Default`. It also gets `KEYS`
/// ([`Key`] per field), `check`, which returns the first field outside its range, and `first_wrong`, which only names it; and, with the feature `schema`
/// of the crate that declares it, a JSON Schema with the same ranges. Attributes of the struct (a serde derive, say)
/// are passed on, of a field `#[serde(…)]` and `#[schemars(…)]`, in this order.
///
/// A field's doc comment is also its help text: what it means, with the unit in parentheses, then a list with
/// "Symbol:", "Equation:" and "Source:", as far as there are any.
///
/// ```
/// uchain_core::params! {
///     /// Gains of a law.
///     pub struct GainParams {
///         /// Proportional gain (1/s).
///         /// - Symbol: k
///         /// - Source: a textbook
///         pub gain_per_s: f32 = 0.5, in 0.0..=10.0;
///     }
/// }
/// assert!(GainParams::default().check().is_ok());
/// assert_eq!(GainParams { gain_per_s: -1.0 }.check().unwrap_err().low, 0.0);
/// assert!(GainParams { gain_per_s: f32::NAN }.check().is_err());
/// assert_eq!(GainParams { gain_per_s: f32::NAN }.first_wrong(), Some("gain_per_s"));
/// assert!(GainParams { gain_per_s: 10.0 }.check().is_ok());
/// assert_eq!(GainParams::KEYS[0].name, "gain_per_s");
/// assert!(GainParams::KEYS[0].doc.ends_with(" - Symbol: k\n - Source: a textbook\n"));
/// ```
#[macro_export]
macro_rules! params {
    (
        $(#[$meta:meta])*
        pub struct $Name:ident {
            $(
                $(#[doc = $doc:literal])*
                $(#[serde $serde:tt])?
                $(#[schemars $schemars:tt])?
                pub $field:ident: $ty:ty $(= $default:expr)? $(, in $low:literal..=$high:literal)?;
            )*
        }
    ) => {
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        pub struct $Name {
            $(
                $(#[doc = $doc])*
                $(#[serde $serde])?
                $(#[cfg_attr(feature = "schema", schemars $schemars)])?
                $(#[cfg_attr(feature = "schema", schemars(range(min = $low, max = $high)))])?
                pub $field: $ty,
            )*
        }

        $crate::params!(@default $Name { $($field $(= $default)?;)* });

        impl $Name {
            /// One entry per field, in order.
            pub const KEYS: &'static [$crate::params::Key] = &[
                $( $crate::params::Key {
                    name: stringify!($field),
                    range: $crate::params!(@range $($low, $high)?),
                    doc: concat!($($doc, "\n"),*),
                }, )*
            ];

            /// The first field outside its range.
            ///
            /// # Errors
            /// [`OutOfRange`]($crate::params::OutOfRange) names the field, what it is and what it may be.
            #[allow(clippy::cast_lossless, clippy::unnecessary_cast, trivial_numeric_casts)]
            pub fn check(&self) -> Result<(), $crate::params::OutOfRange> {
                $( $( $crate::params!(@check self, $field, $ty, $low, $high); )? )*
                Ok(())
            }

            /// The name of the first field outside its range: `check` without the numbers, which are doubles, and dear where
            /// the hardware has none.
            #[allow(clippy::cast_lossless, clippy::unnecessary_cast, trivial_numeric_casts)]
            pub fn first_wrong(&self) -> Option<&'static str> {
                $( $(
                    if !$crate::params!(@is_legal self, $field, $ty, $low, $high) {
                        return Some(stringify!($field));
                    }
                )? )*
                None
            }
        }
    };
    (@default $Name:ident { $( $field:ident = $default:expr; )* }) => {
        impl Default for $Name {
            fn default() -> Self {
                Self { $( $field: $default, )* }
            }
        }
    };
    // A field without a default has to be written: so has the whole.
    (@default $Name:ident { $($fields:tt)* }) => {};
    (@range) => { None };
    (@range $low:literal, $high:literal) => { Some(($low as f64, $high as f64)) };
    // Compared in the field's own type: its rounding of a bound is within the range.
    (@is_legal $self:ident, $field:ident, $ty:ty, $low:literal, $high:literal) => {
        (($low as $ty)..=($high as $ty)).contains(&$self.$field)
    };
    (@check $self:ident, $field:ident, $ty:ty, $low:literal, $high:literal) => {
        if !$crate::params!(@is_legal $self, $field, $ty, $low, $high) {
            let (got, low, high) = ($self.$field as f64, $low as f64, $high as f64);
            return Err($crate::params::OutOfRange { key: stringify!($field), got, low, high });
        }
    };
}
