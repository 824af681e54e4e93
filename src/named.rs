//! Enums whose variants have a name each, said beside the variant.
//!
//! In: an enum, each variant with `= "its name"`, and the head of the method that gives it. Out: the enum, `ALL` in that
//! order, the method. Absent: variants with data, which have a `match`. Equations: none.

macro_rules! named {
    ($(#[$meta:meta])* $vis:vis enum $Enum:ident { $($(#[$doc:meta])* $Variant:ident = $name:literal,)+ }
     $(#[$says:meta])* pub fn $method:ident;) => {
        $(#[$meta])*
        $vis enum $Enum {
            $($(#[$doc])* $Variant,)+
        }

        #[allow(dead_code, reason = "not every enum is gone through")]
        impl $Enum {
            /// All of them, in their order.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$Variant),+];

            $(#[$says])*
            pub const fn $method(self) -> &'static str {
                match self {
                    $(Self::$Variant => $name,)+
                }
            }
        }
    };
}
