//! The one way to declare the codes of mistakes.

/// Declares an enumeration of mistakes: for each its sentence, its name and its code.
///
/// What is declared prints as its code, and has `ALL`, `as_str` and `summary`. With `with Name(Other)` behind its name it
/// also holds every mistake of another such enumeration, which keeps its own list.
///
/// ```
/// tumble_expr::codes! {
///     /// What can be wrong with a letter.
///     enum Code with Formula(tumble_expr::language::Code);
///     /// The envelope has no stamp.
///     Stamp = "E0901";
/// }
/// assert_eq!(Code::Stamp.to_string(), "E0901");
/// assert_eq!(Code::Stamp.summary(), "The envelope has no stamp.");
/// assert_eq!(Code::from(tumble_expr::language::Code::Number).as_str(), "E0105");
/// ```
#[macro_export]
macro_rules! codes {
    (
        $(#[doc = $about:literal])+
        enum $codes:ident $(with $held:ident($other:ty))?;
        $($(#[doc = $doc:literal])+ $name:ident = $code:literal;)*
    ) => {
        $(#[doc = $about])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $codes {
            $(
                /// A mistake of the kind that has its own list.
                $held($other),
            )?
            $($(#[doc = $doc])+ $name,)*
        }

        impl $codes {
            /// Every code that is declared here, in order.
            pub const ALL: &[Self] = &[$(Self::$name),*];

            /// The stable code, such as `E0110`.
            pub fn as_str(self) -> &'static str {
                match self {
                    $(Self::$held(code) => <$other>::as_str(code),)?
                    $(Self::$name => $code,)*
                }
            }

            /// One sentence on what the code stands for.
            pub fn summary(self) -> &'static str {
                match self {
                    $(Self::$held(code) => <$other>::summary(code),)?
                    $(Self::$name => concat!($($doc),+).trim_ascii(),)*
                }
            }
        }

        impl ::std::fmt::Display for $codes {
            fn fmt(&self, f: &mut ::std::fmt::Formatter<'_>) -> ::std::fmt::Result {
                f.write_str(self.as_str())
            }
        }

        $(impl ::std::convert::From<$other> for $codes {
            fn from(code: $other) -> Self {
                Self::$held(code)
            }
        })?
    };
}
