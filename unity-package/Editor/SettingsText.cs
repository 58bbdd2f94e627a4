using System.Globalization;
using Chamfer;

namespace ChamferEditor
{
    /// <summary>Settings as text: equal texts chamfer alike.</summary>
    internal static class SettingsText
    {
        internal static string Of(ChamferSettings settings)
        {
            return Number(settings.width) + " " + settings.unit + " " + settings.verify + " " + settings.submeshMode + " "
                + settings.submesh + " " + Number(settings.leastBreadth);
        }

        /// <summary>For users.</summary>
        internal static string Words(ChamferSettings settings)
        {
            string unit = settings.unit == WidthUnit.PercentOfExtent ? " percent, " : " units, ";
            return Number(settings.width) + unit + settings.verify;
        }

        /// <summary>As it is written on every machine, to the last bit.</summary>
        internal static string Number(float number)
        {
            return number.ToString("R", CultureInfo.InvariantCulture);
        }
    }
}
